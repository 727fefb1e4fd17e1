#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A bag that cannot be played is told with the cure, before any node starts."""

import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import rosbag
from std_msgs.msg import String

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import play_bag

TOPIC = "/plumbline/photo"  # Whatever its type: only play_bag.py reads these bags.


class PlayBagTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, *topics):
        bag = self.folder / f"{len(list(self.folder.iterdir()))}.bag"
        with rosbag.Bag(str(bag), "w") as file:
            for topic in topics:
                file.write(topic, String("a" * 1000))
        return bag

    def test_a_bag_with_the_topic_is_good(self):
        self.assertIsNone(play_bag.fault_of(str(self.write(TOPIC, "/tf")), TOPIC))

    def test_the_first_slash_may_be_left_out(self):
        self.assertIsNone(play_bag.fault_of(str(self.write("image")), "/image"))
        self.assertIsNone(play_bag.fault_of(str(self.write("/image")), "image"))

    def test_faults_name_the_bag_and_the_cure(self):
        empty, text, cut = (self.folder / name for name in ("empty.bag", "text.bag", "cut.bag"))
        empty.write_bytes(b"")
        text.write_text("no bag at all\n")
        cut.write_bytes(self.write(TOPIC).read_bytes()[:-100])
        cases = [(self.folder / "no.bag", TOPIC, "there is no such file", "record:=true"),
                 (self.folder, TOPIC, "is a folder", "name the bag"),
                 (empty, TOPIC, "is empty", "record:=true"),
                 (text, "/image", "is no bag", "with the images"),
                 (cut, TOPIC, "was cut off", f"rosbag reindex {cut}"),
                 (self.write("/tf"), TOPIC, f"no messages on {TOPIC} (it holds /tf)", "record:=true"),
                 (self.write(), "/image", "on /image (it holds nothing)", "image_topic:="),
                 (self.write("/image"), "", "no image_topic", "image_topic:=")]
        for bag, topic, fault, cure in cases:
            told = play_bag.fault_of(str(bag), topic)
            self.assertIn(f"{bag}: ", told)
            self.assertIn(fault, told)
            self.assertIn(cure, told)

    def test_a_relative_path_is_told_as_it_was_meant(self):
        self.assertIn("such as /", play_bag.fault_of("a.bag", TOPIC))

    def run_script(self, *words):
        return subprocess.Popen([sys.executable, play_bag.__file__, *words], text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def test_a_bad_bag_ends_the_player(self):
        run = self.run_script("--rate", "1.0", "/no.bag", TOPIC, "--also", "__name:=play")
        _, said = run.communicate(timeout=60.0)
        self.assertEqual(run.returncode, 78)
        self.assertIn("FATAL] /no.bag: ", said)

    def test_a_node_is_held_while_the_bag_is_bad(self):
        started = self.folder / "started"
        good = self.run_script("--hold", str(self.write(TOPIC)), TOPIC, "--", "touch",
                               str(started))
        self.assertEqual(good.communicate(timeout=60.0), ("", ""))
        self.assertTrue(started.exists())
        started.unlink()
        bad = self.run_script("--hold", "/no.bag", TOPIC, "--", "touch", str(started))
        with self.assertRaises(subprocess.TimeoutExpired):
            bad.communicate(timeout=1.0)
        bad.terminate()
        bad.communicate(timeout=60.0)
        self.assertFalse(started.exists())

    def test_what_a_node_may_not_ignore_is_not_ignored(self):
        run = self.run_script("--hold", str(self.write(TOPIC)), TOPIC, "--",
                              "grep", "SigIgn", "/proc/self/status")
        said, _ = run.communicate(timeout=60.0)
        self.assertEqual(int(said.split()[1], 16) & 1 << (signal.SIGPIPE - 1), 0)


if __name__ == "__main__":
    unittest.main()
