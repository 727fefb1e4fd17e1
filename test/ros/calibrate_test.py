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

import rosbag
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
        (self.card / "100.jpg").write_bytes(wire.JPEG)
        self.wait(lambda message: message.last_photo == "100.jpg" and message.num_unreadable == 1,
                  "100.jpg as unreadable")
        for photo in sorted(self.photos.glob("*.png")):
            shutil.copy(photo, self.card)
        progress = self.wait_for_photos(NUM_PHOTOS)
        self.assertTrue(progress.can_calibrate)
        self.assertFalse(progress.can_save)
        self.assertGreater(sum(progress.heat_map), 16 * 4)
        self.assertEqual({bar.group for bar in progress.bars},
                         {"distance", "tilt", "direction", "turn"})
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

    def image(self, name):
        """A photo as a driver publishes it."""
        header, size, _, data = (self.photos / name).read_bytes().split(b"\n", 3)
        self.assertEqual(header, b"P5")
        width, height = map(int, size.split())
        return Image(width=width, height=height, step=width, encoding="mono8", data=data)

    def publish(self, message):
        """Publishes an image again and again, as a camera does; returns what ends that."""
        publisher = rospy.Publisher(f"{self.namespace}/cam/image", Image, queue_size=1)

        def send(_):
            message.header.stamp += rospy.Duration(5.0)  # Photos, so that none counts as moving.
            publisher.publish(message)
        message.header.stamp = rospy.Time(100)
        timer = rospy.Timer(rospy.Duration(0.1), send)

        def stop():
            timer.shutdown()
            timer.join()
        self.addCleanup(stop)
        return stop

    def test_a_topics_new_views_are_taken_and_the_driver_gets_the_calibration(self):
        self.start(image_topic="cam/image")
        blank = {"width": 64, "height": 48, "step": 64, "data": bytes(64 * 48)}
        for encoding, note in (("mono8", "no markers"), ("odd", '"odd"')):
            stop = self.publish(Image(encoding=encoding, **blank))
            self.wait(lambda message, said=note: said in message.last_photo_note, note)
            stop()
        for count in range(1, 5):
            stop = self.publish(self.image(f"10{count}.pgm"))
            self.wait(lambda message, seen=count: message.num_with_markers == seen and
                      "like one" in message.last_photo_note, f"view {count} and nothing new")
            stop()
        self.assertTrue(self.call("calibrate").success)
        answer = self.call("commit")
        self.assertFalse(answer.success)
        self.assertIn(f"no service {self.namespace}/cam/set_camera_info", answer.message)
        received = []

        def set_camera_info(request):
            received.append(request.camera_info)
            return SetCameraInfoResponse(success=True)
        server = rospy.Service(f"{self.namespace}/cam/set_camera_info", SetCameraInfo,
                               set_camera_info)
        self.addCleanup(server.shutdown)
        answer = self.call("commit")
        self.assertTrue(answer.success, answer.message)
        self.assertEqual((received[0].width, received[0].height), (960, 640))
        self.assertAlmostEqual(received[0].K[0] / focal_of(self.truth), 1.0, delta=0.02)

    def test_a_bag_is_played_and_a_driver_may_refuse(self):
        bag_path = self.folder / "calibration.bag"
        with rosbag.Bag(str(bag_path), "w") as bag:
            for number in range(18):  # 4 images a second; each view stands still for 1.5 s.
                stamp = rospy.Time(1000) + rospy.Duration(0.25 * number)
                image = CompressedImage(format="png")
                image.header.stamp = stamp
                image.data = (self.photos / f"10{1 + number // 6}.png").read_bytes()
                bag.write("/bag/image", image, stamp)
        self.start(image_topic="/bag/image", set_camera_info_service="refuses",
                   max_queue=20)  # However slow the computer, no image is passed over.
        server = rospy.Service(
            f"{self.namespace}/refuses", SetCameraInfo,
            lambda _: SetCameraInfoResponse(success=False, status_message="no memory"))
        self.addCleanup(server.shutdown)
        subprocess.run(["rosrun", "rosbag", "play", "--quiet", "--wait-for-subscribers", bag_path],
                       check=True, timeout=wire.DEADLINE_S, stdin=subprocess.DEVNULL)
        self.wait_for_photos(3)
        self.call("calibrate")
        answer = self.call("commit")
        self.assertFalse(answer.success)
        self.assertRegex(answer.message, "no memory|relied on")

    def test_a_silent_topic_is_named_and_one_of_another_type(self):
        self.start(image_topic="talk")
        self.wait(lambda message: any("no image yet" in t for t in message.source_troubles),
                  "that no image comes")
        publisher = rospy.Publisher(f"{self.namespace}/talk", String, queue_size=1, latch=True)
        publisher.publish("hello")
        self.wait(lambda message: any("std_msgs/String" in t for t in message.source_troubles),
                  "the topic's type")

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
