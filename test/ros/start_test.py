#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A node with a wrong parameter or camera ends at once and names what is wrong."""

import os
import pathlib
import subprocess
import unittest

import rosbag
import rospy
import rostest
from plumbline.msg import Photo, PhotoVerdict, StoredPhotos

import wire


class StartTest(wire.FolderTest):
    def end_of(self, name, **parameters):
        """What a node says that must end by itself with a failure."""
        process = wire.start_node(name, "/start", **parameters)
        said, _ = process.communicate(timeout=wire.DEADLINE_S)
        self.assertEqual(process.returncode, wire.EX_CONFIG, said)
        self.assertEqual(said.count("FATAL"), 1, said)
        return said

    def ingest(self, **parameters):
        defaults = {"photos_folder": self.card, "session_folder": self.session,
                    "camera_file": self.camera}
        return self.end_of("camera_ingest", **{**defaults, **parameters})

    def tearDown(self):
        for parameter in ("/start/camera_ingest", "/start/mapper", "/start/mesher"):
            if rospy.has_param(parameter):
                rospy.delete_param(parameter)

    def test_a_fraction_for_a_whole_number_is_refused(self):
        said = self.ingest(max_in_flight=30.7)
        self.assertIn("max_in_flight", said)
        self.assertIn("30.7", said)

    def test_a_value_out_of_bounds_is_refused(self):
        said = self.ingest(resend_after_s=-1.0)
        self.assertIn("resend_after_s must be positive, but is -1", said)

    def test_an_unknown_name_is_refused(self):
        self.assertIn("foto_folder is unknown", self.ingest(foto_folder="/x"))

    def test_nested_parameters_of_the_mapper_are_checked(self):
        rospy.set_param("/start/mapper/mapper/localizer", {"min_num_inliers": "many"})
        said = self.end_of("mapper", session_folder=self.session)
        self.assertIn("mapper/localizer/min_num_inliers", said)
        self.assertIn("many", said)

    def test_nested_parameters_of_the_mesher_are_checked(self):
        rospy.set_param("/start/mesher/gaps", {"min_views": 1})
        said = self.end_of("mesher", palette="rainbow")
        self.assertIn("gaps/min_views must be at least 2, but is 1", said)
        self.assertIn("palette must be paper or colour_blind", said)
        self.assertIn("config/mesher.yaml", said)

    def test_a_missing_session_is_named(self):
        self.assertIn("session_folder", self.end_of("mapper"))

    def test_a_photos_folder_that_is_a_file_is_named(self):
        self.assertIn("name the folder", self.ingest(photos_folder=self.camera))

    def test_a_relative_path_is_refused_with_what_it_was_meant_to_be(self):
        said = self.ingest(photos_folder="card")
        self.assertIn("photos_folder", said)
        self.assertIn(str(pathlib.Path.cwd() / "card"), said)

    def test_a_missing_camera_file_is_named(self):
        self.assertIn("/no/such/camera.yaml", self.ingest(camera_file="/no/such/camera.yaml"))

    def test_a_camera_without_focal_length_is_named_with_file_and_field(self):
        self.camera.write_text(wire.CAMERA_YAML.replace("[60, 0, 31.5", "[-60, 0, 31.5"))
        said = self.ingest()
        self.assertIn(str(self.camera), said)
        self.assertIn("fx", said)

    def test_a_session_that_another_mapper_writes_is_refused(self):
        namespaces = ("/first", "/second")
        mappers = [wire.start_node("mapper", name, session_folder=self.session)
                   for name in namespaces]
        for mapper in mappers:
            self.addCleanup(lambda mapper=mapper: mapper.poll() is None and wire.end(mapper))
        photo = wire.photo_message(1, "a.jpg", b"no photo")
        for mapper, name in zip(mappers, namespaces):
            verdicts = wire.Heard(f"{name}/photo_verdict", PhotoVerdict)
            photos = rospy.Publisher(f"{name}/photo", Photo, queue_size=1, latch=True)
            photos.publish(photo)
            if mapper is mappers[0]:
                verdicts.wait(len, "a verdict")
            self.addCleanup(verdicts.close)
        said, _ = mappers[1].communicate(timeout=wire.DEADLINE_S)
        self.assertEqual(mappers[1].returncode, wire.EX_CONFIG, said)
        self.assertIn("another program", said)

    def test_a_second_node_of_a_name_is_refused_and_the_first_goes_on(self):
        first = wire.start_node("mapper", "/start", session_folder=self.session)
        self.addCleanup(lambda: first.poll() is None and wire.end(first))
        stored = wire.Heard("/start/stored_photos", StoredPhotos)
        self.addCleanup(stored.close)
        stored.wait(len, "the mapper's start")
        said = self.end_of("mapper", session_folder=self.session)
        self.assertIn("/start/mapper is running already", said)
        self.assertIsNone(first.poll())

    def test_a_killed_node_does_not_keep_the_next_one_from_its_name(self):
        for _ in range(2):
            mapper = wire.start_node("mapper", "/start", session_folder=self.session)
            self.addCleanup(lambda node=mapper: node.poll() is None and wire.end(node))
            stored = wire.Heard("/start/stored_photos", StoredPhotos)
            stored.wait(len, "the mapper's start")
            stored.close()
            mapper.kill()
            mapper.wait()

    def test_roslaunch_ends_after_an_error_that_a_restart_cannot_cure(self):
        launch = subprocess.run(
            ["roslaunch", "--no-summary", "plumbline", "flight.launch", "rviz:=false",
             f"photos:={self.card}", f"session:={self.session}", "camera:=/no/such/camera.yaml"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=wire.DEADLINE_S, check=False)
        self.assertEqual(launch.stdout.count("FATAL"), 1, launch.stdout)
        self.assertIn("/no/such/camera.yaml", launch.stdout)

    def replay(self, bag, session):
        return subprocess.run(
            ["roslaunch", "--no-summary", "plumbline", "replay.launch", "rviz:=false",
             f"bag:={bag}", f"session:={session}"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=self.folder,
            env={**os.environ, "PWD": str(self.folder)}, timeout=wire.DEADLINE_S,
            check=False).stdout

    def test_roslaunch_names_what_a_relative_path_was_meant_to_be(self):
        bag = self.folder / "flight.bag"
        with rosbag.Bag(str(bag), "w") as file:
            file.write("/plumbline/photo", Photo())
        self.assertIn(f"such as {self.folder}/flight, but is", self.replay(bag, "flight"))
        self.assertFalse(self.session.exists())

    def test_a_replay_of_no_bag_ends_and_leaves_no_session(self):
        said = self.replay(self.folder / "no.bag", self.session)
        self.assertIn(f"FATAL] {self.folder}/no.bag: there is no such file", said)
        self.assertFalse(self.session.exists())

    def test_a_name_with_an_umlaut_is_shown_as_it_is(self):
        self.assertIn("/no/such/Türme.yaml", self.ingest(camera_file="/no/such/Türme.yaml"))

    def test_another_camera_than_the_sessions_is_refused(self):
        self.session.mkdir()
        (self.session / "camera.yaml").write_text(wire.CAMERA_YAML.replace("60", "70"))
        self.assertIn("another camera", self.ingest())


if __name__ == "__main__":
    rospy.init_node("start_test")
    rostest.rosrun("plumbline", "start", StartTest)
