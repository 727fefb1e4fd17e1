#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demo says before and after a flight, and of a launch that ends too early."""

import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import demo
from demo_inputs_test import CAMERA


def verdict(verdict_s, work_s):
    return types.SimpleNamespace(verdict_s=verdict_s, decode_s=work_s, features_s=0.0,
                                 retrieval_s=0.0, matching_s=0.0, pose_s=0.0, attempt=1, name="a")


class DemoTest(unittest.TestCase):
    def test_work_and_waiting_are_told_apart(self):
        lines = demo.describe_times([verdict(9.0, 1.0)] * 3, 8.0)
        self.assertEqual(lines[0], "median 9.00 s from photo to verdict, 1.00 s of it work")
        self.assertIn("up to 8 s in the queue", lines[1])
        self.assertEqual(len(demo.describe_times([verdict(1.2, 1.0)], 0.2)), 1)
        self.assertEqual(demo.describe_times([], 0.0), [])

    def test_only_first_verdicts_tell_of_the_queue(self):
        verdicts = demo.Verdicts()
        verdicts.hear(verdict(3.0, 1.0))
        later = verdict(99.0, 1.0)
        later.attempt = 2
        verdicts.hear(later)
        self.assertEqual(verdicts.longest_wait_s(), 2.0)
        self.assertEqual(verdicts.num_photos(), 1)

    def test_targets_are_told_with_their_millimetres_and_what_is_wrong(self):
        target = types.SimpleNamespace(name="5", role="check", state="wrong", error_mm=487.04,
                                       sigma_mm=2.0, num_used=3)
        unseen = types.SimpleNamespace(name="6", state="unseen")
        finding = types.SimpleNamespace(severity="warning", text="target 5 was moved")
        georeference = types.SimpleNamespace(
            source="targets", targets=[target, unseen], findings=[finding], num_control=4,
            control_mean_mm=1.0, control_max_mm=2.0, num_check=0, metres_per_map_unit=0.8)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            demo.print_georeference(georeference)
            demo.print_georeference(None)
        self.assertEqual(said.getvalue().splitlines(), [
            "  target 5: check, wrong, 487.0 mm (expected 2.0), in 3 photos",
            "4 control points: mean 1.00 mm, largest 2.00 mm",
            "Placed by: targets, 0.800000 m a map unit", "  warning: target 5 was moved"])

    def test_a_launch_that_ends_is_told_with_its_reason(self):
        launch = demo.Launch(["bash", "-c", r"echo -e '\e[31m[FATAL] [12.5]: no card\e[0m'; exit 1"])
        with self.assertRaises(SystemExit) as end:
            launch.wait_for(lambda: False, 60.0)
        launch.end()
        self.assertEqual(str(end.exception), "the flight has ended by itself: no card")

    def test_what_rviz_misses_without_harm_is_not_shown(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            launch = demo.Launch(["printf", "%s\n", "before", demo.HARMLESS, "after"])
            launch._process.wait()
            launch.end()
        self.assertEqual(said.getvalue(), "before\nafter\n")

    def test_a_launch_that_runs_is_waited_for(self):
        launch = demo.Launch(["sleep", "60"])
        self.assertFalse(launch.wait_for(lambda: False, 0.0))
        self.assertTrue(launch.wait_for(lambda: True, 60.0))
        launch.end()


    def test_ctrl_c_ends_it_quietly(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "photos").mkdir()
            (folder / "photos" / "1.jpg").write_text("never looked at")
            (folder / "camera.yaml").write_text(CAMERA)
            launch = folder / "roslaunch"  # In place of ROS's: says that it runs, then waits.
            launch.write_text("#!/bin/sh\necho running\nexec sleep 60\n")
            launch.chmod(0o755)
            run = subprocess.Popen(
                [sys.executable, demo.__file__, "--photos", folder / "photos", "--camera",
                 folder / "camera.yaml", "--out", folder / "out"],
                env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "DISPLAY": ":99"},
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual(run.stdout.readline(), "running\n")
            run.send_signal(signal.SIGINT)
            _, errors = run.communicate(timeout=60.0)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(errors, "demo: ended by Ctrl-C\n")


if __name__ == "__main__":
    unittest.main()
