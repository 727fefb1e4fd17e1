#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""camera_ingest on the wire: the test stands where the mapper would."""

import unittest

import rospy
import rostest
from plumbline.msg import Photo, PhotoVerdict, StoredPhotos
from sensor_msgs.msg import CameraInfo, CompressedImage, Image

import wire


class IngestTest(wire.FolderTest):
    number = 0

    def setUp(self):
        super().setUp()
        IngestTest.number += 1
        self.namespace = f"/ingest{IngestTest.number}"
        self.photos = wire.Heard(f"{self.namespace}/photo", Photo)
        self.addCleanup(self.photos.close)
        self.verdicts = rospy.Publisher(f"{self.namespace}/photo_verdict", PhotoVerdict,
                                        queue_size=100)
        self.stored = rospy.Publisher(f"{self.namespace}/stored_photos", StoredPhotos,
                                      queue_size=1, latch=True)

    def start(self, **parameters):
        defaults = {"photos_folder": self.card, "session_folder": self.session,
                    "camera_file": self.camera, "resend_after_s": 1.0}
        node = wire.start_node("camera_ingest", self.namespace, **{**defaults, **parameters})
        self.addCleanup(lambda: wire.end(node) if node.poll() is None else None)
        return node

    def answer(self, photo):
        self.verdicts.publish(PhotoVerdict(sequence=photo.sequence, name=photo.name,
                                           status=PhotoVerdict.ACCEPTED, reason="none"))

    def wait_for_photo(self, name):
        heard = self.photos.wait(lambda photos: any(p.name == name for p in photos), name)
        return [photo for photo in heard if photo.name == name][0]

    def wait_for_sequence(self, sequence, times=1):
        self.photos.wait(lambda photos: sum(p.sequence == sequence for p in photos) >= times,
                         f"photo {sequence}, {times} times")

    def test_a_photo_comes_with_its_bytes_its_camera_and_a_number(self):
        self.start()
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        photo = self.wait_for_photo("a.jpg")
        self.assertEqual(photo.sequence, 1)
        self.assertEqual(photo.image.data, wire.JPEG)
        self.assertEqual(photo.image.format, "jpeg")
        self.assertEqual(photo.header.frame_id, "camera_optical")
        self.assertEqual(photo.camera_info.header.stamp, photo.header.stamp)
        self.assertEqual(photo.camera_info.K[0], 60.0)
        self.assertLessEqual(photo.received, photo.published)
        self.assertEqual((self.session / "photos" / "a.jpg").read_bytes(), wire.JPEG)

    def test_what_is_not_answered_is_sent_again_and_few_at_a_time(self):
        for name in ("c.jpg", "a.jpg", "b.jpg"):
            (self.card / name).write_bytes(wire.JPEG + name.encode() + b"\xff\xd9")
        self.start(max_in_flight=2)
        self.wait_for_sequence(1, times=2)
        self.wait_for_sequence(2, times=2)
        self.assertEqual({p.name for p in self.photos.all()}, {"a.jpg", "b.jpg"})
        self.answer(self.wait_for_photo("a.jpg"))
        self.assertEqual(self.wait_for_photo("c.jpg").sequence, 3)

    def test_a_flight_begins_without_a_recorder_that_does_not_come_and_says_so(self):
        diagnostics = wire.Diagnostics()
        self.addCleanup(diagnostics.close)
        self.start(recorder_wait_s=2.0)
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        self.wait_for_photo("a.jpg")
        diagnostics.wait_for_error("photos are not recorded")
        (self.card / "b.jpg").write_bytes(wire.JPEG + b"b\xff\xd9")
        self.wait_for_photo("b.jpg")

    def test_after_a_restart_the_numbers_go_on_and_what_is_stored_is_not_sent(self):
        node = self.start()
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        self.wait_for_photo("a.jpg")
        node.kill()
        node.wait()
        self.stored.publish(StoredPhotos(mapper_started=rospy.Time(5), sequences=[1]))
        self.photos.close()
        self.photos = wire.Heard(f"{self.namespace}/photo", Photo)
        (self.card / "b.jpg").write_bytes(wire.JPEG + b"b\xff\xd9")
        self.start()
        self.assertEqual(self.wait_for_photo("b.jpg").sequence, 2)
        self.wait_for_sequence(2, times=3)  # Long enough for photo 1 to be sent, were it not known.
        late = [p.sequence for p in self.photos.all()][-2:]
        self.assertEqual(late, [2, 2])

    def test_a_restarted_mapper_gets_what_it_did_not_store(self):
        self.start()
        (self.card / "a.jpg").write_bytes(wire.JPEG)
        self.answer(self.wait_for_photo("a.jpg"))
        num_before = len(self.photos.all())
        self.stored.publish(StoredPhotos(mapper_started=rospy.Time(6), sequences=[]))
        self.photos.wait(lambda photos: len(photos) > num_before, "photo 1 again")

    def test_a_card_works_by_its_root_and_may_be_put_in_later_and_pulled(self):
        self.card.rmdir()
        node = self.start()
        diagnostics = wire.Diagnostics()
        self.addCleanup(diagnostics.close)
        diagnostics.wait_for_error("Put the card in")
        for folder, content in (("100MEDIA", b"one"), ("101MEDIA", b"two")):
            (self.card / "DCIM" / folder).mkdir(parents=True)
            (self.card / "DCIM" / folder / "DJI_0001.JPG").write_bytes(wire.JPEG + content +
                                                                      b"\xff\xd9")
        self.wait_for_sequence(2)
        self.assertEqual({photo.name for photo in self.photos.all()},
                         {"DJI_0001.JPG", "101MEDIA_DJI_0001.JPG"})
        diagnostics.wait_for_figure("camera_ingest", "photos taken", "2")
        self.card.rename(self.folder / "pulled")
        diagnostics.wait_for_error("Put the card in")
        (self.folder / "pulled").rename(self.card)
        diagnostics.wait_for_no_error()
        said = wire.end(node)
        self.assertEqual(said.count("ERROR"), 2, said)
        self.assertEqual(said.count("the folder is there now"), 2, said)

    def test_a_file_is_not_taken_before_it_is_complete(self):
        self.start(untouched_for_s=1000.0)
        with open(self.card / "slow.jpg", "wb") as file:
            file.write(wire.JPEG[:5])
            file.flush()
            (self.card / "other.jpg").write_bytes(wire.JPEG)
            self.wait_for_photo("other.jpg")
            self.assertFalse(any(p.name == "slow.jpg" for p in self.photos.all()))
            file.write(b"more" + wire.JPEG[5:])
        self.assertEqual(self.wait_for_photo("slow.jpg").image.data,
                         wire.JPEG[:5] + b"more" + wire.JPEG[5:])

    def camera_info(self):
        return CameraInfo(width=64, height=48, distortion_model="plumb_bob", D=[0.0] * 5,
                          K=[60.0, 0, 31.5, 0, 60.0, 23.5, 0, 0, 1])

    def test_images_of_a_topic_are_kept_as_png_with_their_stamp(self):
        info = rospy.Publisher(f"{self.namespace}/camera_info", CameraInfo, queue_size=1,
                               latch=True)
        images = rospy.Publisher(f"{self.namespace}/image", Image, queue_size=1, latch=True)
        info.publish(self.camera_info())
        self.start(photos_folder="", camera_file="", image_topic="image")
        image = Image(width=64, height=48, step=64 * 3, encoding="rgb8", data=bytes(64 * 48 * 3))
        image.header.stamp = rospy.Time(12, 34)
        timer = rospy.Timer(rospy.Duration(0.2), lambda _: images.publish(image))
        self.addCleanup(timer.shutdown)  # Images before the camera_info are dropped.
        photo = self.wait_for_photo("12000000034.png")
        self.assertEqual(photo.header.stamp, rospy.Time(12, 34))
        self.assertEqual(photo.image.format, "png")
        self.assertEqual(photo.camera_info.K[0], 60.0)

    def test_compressed_images_of_a_topic_keep_their_bytes(self):
        images = rospy.Publisher(f"{self.namespace}/compressed", CompressedImage, queue_size=1,
                                 latch=True)
        image = CompressedImage(format="jpeg", data=wire.JPEG)
        image.header.stamp = rospy.Time(56, 78)
        images.publish(image)
        self.start(photos_folder="", compressed_image_topic="compressed")
        self.assertEqual(self.wait_for_photo("56000000078.jpg").image.data, wire.JPEG)


if __name__ == "__main__":
    rospy.init_node("ingest_test")
    rostest.rosrun("plumbline", "ingest", IngestTest)
