#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A disk that fills in flight and has space again: nothing is lost, and it is said once."""

import json
import subprocess

import rospy
import rostest
from plumbline.msg import Photo, PhotoVerdict
from sensor_msgs.msg import CompressedImage
from std_srvs.srv import Trigger

import wire


class FullDiskTest(wire.FolderTest):
    """The session lies on a disk of four megabytes."""

    def setUp(self):
        super().setUp()
        self.session.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", self.session],
                               capture_output=True, text=True, check=False)
        if mount.returncode != 0:
            self.skipTest(f"cannot mount a small disk here: {mount.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", "--lazy", self.session], check=True)
        self.ballast = self.session / "ballast"
        self.diagnostics = wire.Diagnostics()
        self.addCleanup(self.diagnostics.close)

    def start(self, name, namespace, **parameters):
        node = wire.start_node(name, namespace, session_folder=self.session, **parameters)
        self.addCleanup(lambda: wire.end(node) if node.poll() is None else None)
        return node

    def fill_the_disk(self):
        with open(self.ballast, "wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                return

    def assert_said_once(self, node):
        said = wire.end(node)
        self.assertEqual(said.count("ERROR"), 1, said)
        self.assertEqual(said.count("going on: 1 "), 1, said)

    def test_finish_says_why_it_cannot_and_can_once_there_is_space(self):
        node = self.start("mapper", "/full_mapper")
        verdicts = wire.Heard("/full_mapper/photo_verdict", PhotoVerdict)
        self.addCleanup(verdicts.close)
        photos = rospy.Publisher("/full_mapper/photo", Photo, queue_size=10, latch=True)
        finish = rospy.ServiceProxy("/full_mapper/finish", Trigger)
        finish.wait_for_service(wire.DEADLINE_S)
        photos.publish(wire.photo_message(1, "a.jpg", b"no photo"))
        verdicts.wait(lambda heard: len(heard) == 1, "the first verdict")
        self.assertTrue(finish().success)

        self.fill_the_disk()
        photos.publish(wire.photo_message(2, "b.jpg", b"no photo either"))
        verdicts.wait(lambda heard: len(heard) == 2, "the second verdict")
        answer = finish()
        self.assertFalse(answer.success)
        self.assertIn("free some space", answer.message)
        self.diagnostics.wait_for_error("free some space")

        self.ballast.unlink()
        self.diagnostics.wait_for_no_error()
        self.assertTrue(finish().success)
        report = json.loads((self.session / "report.json").read_text())
        self.assertEqual(len(report["photos"]), 2)
        self.assert_said_once(node)

    def test_a_photo_of_the_card_is_taken_up_once_there_is_space(self):
        node = self.start("camera_ingest", "/full_card", photos_folder=self.card,
                          camera_file=self.camera)
        photos = wire.Heard("/full_card/photo", Photo)
        self.addCleanup(photos.close)
        self.diagnostics.wait_for_no_error()
        self.fill_the_disk()
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        self.diagnostics.wait_for_error("free some space")
        self.ballast.unlink()
        photos.wait(len, "the photo")
        self.assert_said_once(node)

    def test_an_image_of_a_topic_is_taken_up_once_there_is_space(self):
        node = self.start("camera_ingest", "/full_topic", compressed_image_topic="compressed",
                          camera_file=self.camera)
        photos = wire.Heard("/full_topic/photo", Photo)
        self.addCleanup(photos.close)
        self.diagnostics.wait_for_no_error()
        self.fill_the_disk()
        images = rospy.Publisher("/full_topic/compressed", CompressedImage, queue_size=1,
                                 latch=True)
        image = CompressedImage(format="jpeg", data=wire.JPEG)
        image.header.stamp = rospy.Time(12, 34)
        images.publish(image)
        self.diagnostics.wait_for_error("free some space")
        self.ballast.unlink()
        self.assertEqual(photos.wait(len, "the image")[0].image.data, wire.JPEG)
        self.assert_said_once(node)


if __name__ == "__main__":
    rospy.init_node("full_disk_test")
    rostest.rosrun("plumbline", "full_disk", FullDiskTest)
