#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The calibrator on the wire, without its window: folder, topics, services."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile

import rospy
import rostest
from plumbline.msg import CalibrationProgress
from sensor_msgs.msg import CompressedImage, Image
from sensor_msgs.srv import SetCameraInfo, SetCameraInfoResponse
from std_msgs.msg import String
from std_srvs.srv import Trigger

import wire

NUM_PHOTOS = 6


def focal_of(yaml):
    return float(re.search(r"data: \[([-+.e\d]+)", yaml)[1])


class CalibrateTest(wire.FolderTest):
    number = 0

    @classmethod
    def setUpClass(cls):
        cls.photos = pathlib.Path(tempfile.mkdtemp(prefix="plumbline_"))
        cls.truth = subprocess.run(
            ["rosrun", "plumbline", "make_calibration_photos", cls.photos, str(NUM_PHOTOS)],
            check=True, capture_output=True, text=True).stdout

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.photos, ignore_errors=True)

    def setUp(self):
        super().setUp()
        CalibrateTest.number += 1
        self.namespace = f"/calibrate{CalibrateTest.number}"
        self.progress = wire.Heard(f"{self.namespace}/calibrator/progress", CalibrationProgress)
        self.addCleanup(self.progress.close)

    def start(self, **parameters):
        defaults = {"window": False, "output_folder": self.folder / "calibration"}
        node = wire.start_node("calibrator", self.namespace, **{**defaults, **parameters})
        self.addCleanup(lambda: wire.end(node) if node.poll() is None else None)
        return node

    def call(self, name):
        service = f"{self.namespace}/calibrator/{name}"
        rospy.wait_for_service(service, wire.DEADLINE_S)
        return rospy.ServiceProxy(service, Trigger)()

    def wait(self, is_it, what):
        heard = self.progress.wait(lambda messages: any(map(is_it, messages)), what)
        return [message for message in heard if is_it(message)][-1]

    def wait_for_photos(self, count):
        return self.wait(lambda message: message.num_with_markers >= count, f"{count} photos")

    def test_a_folder_is_calibrated_and_saved(self):
        self.start(photos_folder=self.card, image_topic="")
        self.assertFalse(self.call("calibrate").success)
        for photo in sorted(self.photos.iterdir()):
            shutil.copy(photo, self.card)
        progress = self.wait_for_photos(NUM_PHOTOS)
        self.assertTrue(progress.can_calibrate)
        self.assertGreater(sum(progress.heat_map), 16 * 4)
        self.assertIn("tilt", {bar.group for bar in progress.bars})
        self.assertFalse(self.call("save").success)
        answer = self.call("calibrate")
        self.assertTrue(answer.success, answer.message)
        self.assertIn(f"from {NUM_PHOTOS} photos", answer.message)
        answer = self.call("save")
        self.assertTrue(answer.success, answer.message)
        saved = (self.folder / "calibration" / "camera.yaml").read_text()
        self.assertAlmostEqual(focal_of(saved) / focal_of(self.truth), 1.0, delta=0.01)
        self.assertTrue((self.folder / "calibration" / "report.md").exists())
        answer = self.call("commit")
        self.assertFalse(answer.success)
        self.assertIn("no camera", answer.message)

    def test_a_photo_that_cannot_be_read_is_named_and_the_next_is_taken(self):
        self.start(photos_folder=self.card, image_topic="")
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        self.wait(lambda message: message.last_photo == "a.jpg" and message.num_unreadable == 1,
                  "a.jpg as unreadable")
        shutil.copy(self.photos / "101.png", self.card)
        self.wait_for_photos(1)

    def publish(self, topic, message):
        """Publishes a message again and again, as a camera does."""
        publisher = rospy.Publisher(topic, type(message), queue_size=1)

        def send(_):
            message.header.stamp += rospy.Duration(5.0)  # Photos, so that none counts as moving.
            publisher.publish(message)
        message.header.stamp = rospy.Time(100)
        timer = rospy.Timer(rospy.Duration(0.2), send)

        def stop():
            timer.shutdown()
            timer.join()
            publisher.unregister()
        self.addCleanup(stop)
        return stop

    def publish_photo(self, name):
        data = (self.photos / name).read_bytes()
        return self.publish(f"{self.namespace}/cam/image", CompressedImage(format="png", data=data))

    def test_a_topics_new_views_are_taken_and_the_driver_gets_the_calibration(self):
        received = []

        def set_camera_info(request):
            received.append(request.camera_info)
            return SetCameraInfoResponse(success=True)
        self.start(image_topic="cam/image")
        for count, name in enumerate(("101.png", "102.png", "103.png", "104.png"), start=1):
            stop = self.publish_photo(name)
            self.wait_for_photos(count)
            self.wait(lambda message, seen=count: message.num_with_markers == seen and
                      "like one" in message.last_photo_note, "the same view left out")
            stop()
        self.assertTrue(self.call("calibrate").success)
        answer = self.call("commit")
        self.assertFalse(answer.success)
        self.assertIn(f"no service {self.namespace}/cam/set_camera_info", answer.message)
        server = rospy.Service(f"{self.namespace}/cam/set_camera_info", SetCameraInfo,
                               set_camera_info)
        self.addCleanup(server.shutdown)
        answer = self.call("commit")
        self.assertTrue(answer.success, answer.message)
        self.assertEqual((received[0].width, received[0].height), (960, 640))
        self.assertGreater(received[0].K[0], 100.0)

    def test_images_without_markers_and_of_odd_kinds_are_told(self):
        self.start(image_topic="cam/image")
        image = Image(width=64, height=48, step=64, encoding="mono8", data=bytes(64 * 48))
        stop = self.publish(f"{self.namespace}/cam/image", image)
        self.wait(lambda message: "no markers" in message.last_photo_note, "no markers")
        stop()
        odd = Image(width=64, height=48, step=64, encoding="odd", data=bytes(64 * 48))
        self.publish(f"{self.namespace}/cam/image", odd)
        self.wait(lambda message: '"odd"' in message.last_photo_note, "the odd encoding")

    def test_a_topic_of_another_type_is_named(self):
        self.start(image_topic="talk")
        publisher = rospy.Publisher(f"{self.namespace}/talk", String, queue_size=1, latch=True)
        publisher.publish("hello")
        self.wait(lambda message: any("std_msgs/String" in t for t in message.source_troubles),
                  "the topic's type")

    def test_a_silent_topic_is_named(self):
        self.start(image_topic="cam/image")
        self.wait(lambda message: any("no image yet" in t for t in message.source_troubles),
                  "that no image comes")

    def start_with_window(self, **environment):
        return subprocess.Popen(
            ["rosrun", "plumbline", "calibrator", f"__ns:={self.namespace}",
             f"_photos_folder:={self.card}", f"_output_folder:={self.folder}/calibration"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            env={**{key: value for key, value in os.environ.items()
                    if key not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")},
                 **environment})

    def test_without_a_display_it_says_what_to_do(self):
        node = self.start_with_window()
        said, _ = node.communicate(timeout=wire.DEADLINE_S)
        self.assertEqual(node.returncode, wire.EX_CONFIG, said)
        self.assertIn("window:=false", said)

    def test_an_interrupted_window_ends_cleanly(self):
        node = self.start_with_window(QT_QPA_PLATFORM="offscreen")
        self.addCleanup(lambda: node.poll() is None and node.kill())
        shutil.copy(self.photos / "101.png", self.card)
        self.wait_for_photos(1)
        wire.end(node)
        self.assertEqual(node.returncode, 0)


if __name__ == "__main__":
    rospy.init_node("calibrate_test")
    rostest.rosrun("plumbline", "calibrate", CalibrateTest)
