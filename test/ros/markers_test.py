#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""marker_detector on the wire: the test stands where camera_ingest would."""

import subprocess
import unittest

import numpy
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from plumbline.msg import MarkerDetectionArray, Photo
from sensor_msgs.msg import Image

import wire

# Codes as printed, by ID; bit i is cell i. The faces are drawn anew here, from docs/markers.md.
WORDS = {0: 1039, 105: 30645}
NUM_CELLS = 17
SAMPLES = 4  # Of a pixel, along each axis.
WHITE, BLACK, BACKGROUND = 210, 40, 120


def is_white(word, x, y):
    """Of points in outer radii, y down."""
    radius = numpy.hypot(x, y)
    cell = (numpy.arctan2(y, x) % (2 * numpy.pi)) * NUM_CELLS / (2 * numpy.pi)
    is_bit_set = (word >> numpy.minimum(cell, NUM_CELLS - 1).astype(int)) & 1 == 1
    is_in_stripe = (radius >= 0.42) & (radius < 0.8)
    return (radius >= 1.0) | (radius < 0.2) | (is_in_stripe & is_bit_set)


def draw(width, height, markers):
    """A grey photo with upright markers (ID, x, y, radius), as PNG."""
    side = numpy.arange(SAMPLES) / SAMPLES + 0.5 / SAMPLES - 0.5
    x = (numpy.arange(width)[:, None] + side).ravel()[None, :]
    y = (numpy.arange(height)[:, None] + side).ravel()[:, None]
    fine = numpy.full((height * SAMPLES, width * SAMPLES), float(BACKGROUND))
    for marker_id, center_x, center_y, radius in markers:
        in_x, in_y = numpy.broadcast_arrays((x - center_x) / radius, (y - center_y) / radius)
        is_plate = (abs(in_x) < 1.25) & (abs(in_y) < 1.25)
        white = is_white(WORDS[marker_id], in_x, in_y)
        fine[is_plate] = numpy.where(white, WHITE, BLACK)[is_plate]
    photo = fine.reshape(height, SAMPLES, width, SAMPLES).mean(axis=(1, 3)).astype(numpy.uint8)
    pgm = b"P5 %d %d 255\n" % (width, height) + photo.tobytes()
    return subprocess.run(["convert", "pgm:-", "png:-"], input=pgm, stdout=subprocess.PIPE,
                          check=True).stdout


class MarkersTest(unittest.TestCase):
    number = 0

    def setUp(self):
        MarkersTest.number += 1
        self.namespace = f"/markers{MarkersTest.number}"
        self.answers = self.hear("marker_detections", MarkerDetectionArray)
        self.photos = rospy.Publisher(f"{self.namespace}/photo", Photo, queue_size=100)

    def hear(self, topic, message_type):
        heard = wire.Heard(f"{self.namespace}/{topic}", message_type)
        self.addCleanup(heard.close)
        return heard

    def start(self, **parameters):
        node = wire.start_node("marker_detector", self.namespace, **parameters)
        self.addCleanup(lambda: wire.end(node) if node.poll() is None else None)
        wire.wait_until(
            lambda: self.photos.get_num_connections() and self.answers.is_connected(),
            "a marker_detector that listens and is heard")
        return node

    def photo(self, sequence, data, width=320, height=240):
        message = wire.photo_message(sequence, f"{sequence}.png", data)
        message.header.stamp = rospy.Time(1000 + sequence, 5)
        message.header.frame_id = "camera_optical"
        message.camera_info.width, message.camera_info.height = width, height
        message.camera_info.K = [300.0, 0, width / 2 - 0.5, 0, 300.0, height / 2 - 0.5, 0, 0, 1]
        return message

    def wait_for(self, sequence, times=1):
        """The last answer to a photo."""
        heard = self.answers.wait(
            lambda answers: sum(a.sequence == sequence for a in answers) >= times,
            f"the answer to photo {sequence}, {times} times")
        return [answer for answer in heard if answer.sequence == sequence][-1]

    def test_markers_are_found_where_they_are_with_the_photos_header_and_shown(self):
        shown = [(0, 80.25, 60.5, 20.0), (105, 230.75, 150.25, 30.0)]
        pictures = self.hear("annotated_markers", Image)
        self.start()
        photo = self.photo(7, draw(320, 240, shown))
        self.photos.publish(photo)
        answer = self.wait_for(7)
        self.assertEqual(answer.header.stamp, photo.header.stamp)
        self.assertEqual(answer.header.frame_id, "camera_optical")
        self.assertEqual((answer.name, answer.reason), ("7.png", ""))
        self.assertGreater(answer.latency_s, 0.0)
        self.assertEqual([marker.id for marker in answer.detections], [0, 105])
        for marker, (_, x, y, radius) in zip(answer.detections, shown):
            numpy.testing.assert_allclose(marker.center_px, [x, y], atol=0.03)
            numpy.testing.assert_allclose(marker.ellipse_center_px, [x, y], atol=0.2)
            numpy.testing.assert_allclose([marker.semi_major_px, marker.semi_minor_px], radius,
                                          atol=0.5)
            self.assertLess(marker.center_covariance_px2[0], 0.03 ** 2)
            numpy.testing.assert_allclose(  # Upright, and of its size.
                marker.pixel_from_marker, [radius, 0, x, 0, radius, y, 0, 0, 1], atol=0.25)
            self.assertGreater(marker.probability, 0.9999)
        picture = pictures.wait(len, "the annotated photo")[0]
        self.assertEqual((picture.encoding, picture.width), ("bgr8", 320))
        self.assertGreater(picture.height, 240)

    def test_what_cannot_be_searched_is_answered_with_a_reason_and_the_next_photo_is_searched(self):
        node = self.start()
        data = draw(320, 240, [(0, 100.0, 100.0, 25.0)])
        nonsense = self.photo(4, data)
        nonsense.camera_info.distortion_model = "fisheye"
        bad = {1: (self.photo(1, b""), "empty"), 2: (self.photo(2, b"this is no photo"), "no photo"),
               3: (self.photo(3, data, width=640, height=480), "320 x 240"),
               4: (nonsense, "fisheye"), 5: (self.photo(5, data[:len(data) // 2]), "")}
        for photo, _ in bad.values():
            self.photos.publish(photo)
        self.photos.publish(Photo())  # No sequence: there is nothing to answer.
        self.photos.publish(self.photo(6, data))
        for sequence, (_, reason) in bad.items():
            answer = self.wait_for(sequence)
            self.assertNotEqual(answer.reason, "", sequence)
            self.assertIn(reason, answer.reason)
            self.assertEqual(answer.detections, [])
        self.assertEqual([marker.id for marker in self.wait_for(6).detections], [0])
        self.assertIsNone(node.poll())

    def test_a_photo_sent_again_gets_its_answer_again(self):
        self.start()
        photo = self.photo(1, draw(320, 240, [(0, 100.0, 100.0, 25.0)] * 2))
        self.photos.publish(photo)
        first = self.wait_for(1)
        photo.image.data = b"not read again"
        self.photos.publish(photo)
        again = self.wait_for(1, times=2)
        again.header.seq = first.header.seq  # Which counts messages.
        self.assertEqual(again, first)

    def test_each_photo_is_answered_where_the_queue_is_full_with_that_reason(self):
        self.start(max_queue=1)
        data = draw(1200, 900, [(0, 300.0, 400.0, 25.0), (0, 800.0, 500.0, 40.0)])
        photos = {number: self.photo(number, data, 1200, 900) for number in range(1, 21)}
        for photo in photos.values():
            self.photos.publish(photo)
        answers = [self.wait_for(number) for number in photos]
        refused = [answer for answer in answers if answer.reason]
        self.assertTrue(refused)
        self.assertLess(len(refused), len(answers))
        for answer in answers:
            self.assertEqual(len(answer.detections), 0 if answer.reason else 2, answer.reason)
        self.assertIn("queue is full", refused[0].reason)
        self.photos.publish(photos[refused[0].sequence])  # Another chance.
        self.assertEqual(self.wait_for(refused[0].sequence, times=2).reason, "")

    def test_diagnostics_tell_latency_queue_and_drops(self):
        diagnostics = wire.Diagnostics()
        self.addCleanup(diagnostics.close)
        self.start()
        self.photos.publish(self.photo(1, draw(320, 240, [(105, 100.0, 100.0, 25.0)])))
        self.wait_for(1)

        def tells_all(messages):
            for status in (status for message in messages for status in message.status):
                values = {value.key: value.value for value in status.values}
                if status.level == DiagnosticStatus.OK and values.get("markers found") == "1":
                    return {"latency last [s]", "queue", "photos dropped"} <= set(values)
            return False
        diagnostics.wait(tells_all, "latency, queue and drops")


if __name__ == "__main__":
    rospy.init_node("markers_test")
    rostest.rosrun("plumbline", "markers", MarkersTest)
