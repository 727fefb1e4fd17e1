#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""flight.launch with photos of a simulated facade with surveyed targets, placed on earth in flight."""

import collections
import csv
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest
from xmlrpc.client import ServerProxy

import numpy
import rosgraph
import rospy
import rostest
from plumbline.msg import (ControlPoint, ControlPoints, Georeference, MapDelta, MarkerDetection,
                           MarkerDetectionArray, PhotoPositions, PhotoVerdict)
from plumbline.srv import GetMap, GetMarkerDetections, LoadSurvey
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

import wire

SCENARIO = """\
description: A few small photos of a wall with nine targets
seed: 1
samples_per_axis: 1
facade: {width_m: 9.0, height_m: 10.0, depth_m: 5.0, num_storeys: 2, num_doors: 0, num_downpipes: 0, num_targets: 9}
lens: {width_px: 1500, height_px: 1000}
survey: {check_share: 0.25}
flight:
  legs:
    - row: 5m
      distance_m: 5.0
      x_min_m: 0.0
      x_max_m: 9.0
      z_min_m: 0.5
      z_max_m: 10.0
      side_overlap: 0.7
      num_photos: 12
"""
NUM_PHOTOS = 12

NAN = float("nan")


def kill_node(name):
    """Ends a node by SIGKILL, as a crash would."""
    master = rosgraph.Master("/georeference_test")
    _, _, process_id = ServerProxy(master.lookupNode(name)).getPid("/georeference_test")
    os.kill(process_id, signal.SIGKILL)


def states(georeference):
    return {target.id: target.state for target in georeference.targets}


def residuals(georeference):
    """By target [mm]."""
    return {target.id: target.residual_mm for target in georeference.targets
            if target.state in ("good", "wrong")}


def codes(georeference):
    return {finding.code for finding in georeference.findings}


class GeoreferenceTest(wire.FolderTest):
    @classmethod
    def setUpClass(cls):
        cls.simulated = pathlib.Path(tempfile.mkdtemp(prefix="plumbline_"))
        (cls.simulated / "scenario.yaml").write_text(SCENARIO)
        cls.world = cls.simulated / "flight"
        subprocess.run(["rosrun", "plumbline", "plumbline", "simulate", "--no-bag", "--scenario",
                        str(cls.simulated / "scenario.yaml"), "--output", str(cls.world)],
                       check=True, stdout=subprocess.DEVNULL)
        cls.photos = sorted((cls.world / "photos").iterdir())
        with open(cls.world / "survey.csv", newline="") as file:
            cls.survey = list(csv.DictReader(file))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.simulated, ignore_errors=True)

    def setUp(self):
        super().setUp()
        self.camera = self.world / "camera.yaml"
        self.verdicts = self.hear("photo_verdict", PhotoVerdict)
        self.georeferences = self.hear("georeference", Georeference)

    def hear(self, topic, message_type):
        heard = wire.Heard(f"/plumbline/{topic}", message_type)
        self.addCleanup(heard.close)
        return heard

    def fly(self, **arguments):
        process = subprocess.Popen(
            ["roslaunch", "--no-summary", "plumbline", "flight.launch", "rviz:=false",
             f"photos:={self.card}", f"session:={self.session}", f"camera:={self.camera}"] +
            [f"{key}:={value}" for key, value in arguments.items()])
        self.addCleanup(self.stop, process)
        return process

    @staticmethod
    def stop(process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            process.wait(wire.DEADLINE_S)

    def leave(self, photos):
        for photo in photos:
            shutil.copy(photo, self.folder)
            (self.folder / photo.name).rename(self.card / photo.name)

    def wait_for_verdicts(self, number):
        self.verdicts.wait(lambda heard: len({v.name for v in heard}) >= number,
                           f"verdicts of {number} photos")

    def wait_for(self, is_it, what):
        """The last georeference of which it holds, once there is one."""
        heard = self.georeferences.wait(lambda all_of_them: any(map(is_it, all_of_them)), what)
        return [georeference for georeference in heard if is_it(georeference)][-1]

    def has_all_targets(self, georeference):
        return (georeference.source == "targets" and
                georeference.num_control + georeference.num_check == len(self.survey))

    def wait_for_all_targets(self, num_before=0):
        """Of what is heard after the first `num_before` georeferences."""
        heard = self.georeferences.wait(
            lambda heard: any(map(self.has_all_targets, heard[num_before:])), "all targets")
        return [g for g in heard[num_before:] if self.has_all_targets(g)][-1]

    def wait_for_settled(self, is_it=lambda georeference: True):
        """The georeference with all that the photos show, and the last delta it was told of."""
        accepted = {v.sequence for v in self.verdicts.all() if v.status == PhotoVerdict.ACCEPTED}
        service = "/plumbline/get_marker_detections"
        rospy.wait_for_service(service, wire.DEADLINE_S)
        ask = rospy.ServiceProxy(service, GetMarkerDetections)
        wire.wait_until(lambda: len(ask().answers) == NUM_PHOTOS, "an answer for each photo")
        num_photos = collections.Counter(
            marker_id for answer in ask().answers if answer.sequence in accepted
            for marker_id in {marker.id for marker in answer.detections})
        return self.wait_for(
            lambda g: {target.id: target.num_photos for target in g.targets} == num_photos and
            g.num_control + g.num_check == len(self.survey) and is_it(g), f"{num_photos}")

    def finish(self):
        """The georeference of the finished map, which no bundle moves any more."""
        self.assertTrue(rospy.ServiceProxy("/plumbline/finish", Trigger)().success)
        sequence = rospy.ServiceProxy("/plumbline/get_map", GetMap)().snapshot.sequence
        return self.wait_for_settled(lambda g: g.map_sequence == sequence)

    def write_survey(self, name, rows):
        path = self.folder / name
        with open(path, "w", newline="") as file:
            writer = csv.DictWriter(file, list(self.survey[0]))
            writer.writeheader()
            writer.writerows(rows)
        return path

    def load(self, path, **words):
        rospy.wait_for_service("/plumbline/load_survey", wire.DEADLINE_S)
        return rospy.ServiceProxy("/plumbline/load_survey", LoadSurvey)(path=str(path), **words)

    def swapped(self):
        rows = [dict(row) for row in self.survey]
        control = [row for row in rows if row["role"] == "control"]
        control[1]["id"], control[4]["id"] = control[4]["id"], control[1]["id"]
        return self.write_survey("swapped.csv", rows), {int(control[1]["id"]),
                                                        int(control[4]["id"])}

    def move_to_austria(self, name, east_m):
        """The same targets, so far east of where the photos were taken."""
        return self.write_survey(name, [
            {**row, "x_m": float(row["x_m"]) - 66226.9 + east_m,
             "y_m": float(row["y_m"]) + 213633.0} for row in self.survey])

    def load_elsewhere(self):
        """A survey of another place is refused, and the one before stays."""
        before = self.georeferences.all()[-1].survey
        answer = self.load(self.move_to_austria("elsewhere.csv", 5000.0), crs="EPSG:31256")
        self.assertFalse(answer.success)
        for words in ("elsewhere.csv: lies", "from where the photos' GPS is", "give the CRS",
                      f"{before} stays in use"):
            self.assertIn(words, answer.message)
        self.assertEqual(self.georeferences.all()[-1].survey, before)

    def load_what_does_not_place(self):
        """Sound files that would leave the map without its place."""
        in_mm = [{**row, **{key: 1000.0 * float(row[key]) for key in ("x_m", "y_m", "z_m")}}
                 for row in self.survey]
        for path, words in ((self.write_survey("two.csv", self.survey[:2]), "three that are not"),
                            (self.write_survey("in_mm.csv", in_mm), "in millimetres")):
            answer = self.load(path)
            self.assertFalse(answer.success)
            for word in (path.name, words, "survey.csv stays in use", "load an empty path before"):
                self.assertIn(word, answer.message)
        self.assertEqual(self.georeferences.all()[-1].source, "targets")

    def load_on_earth(self):
        """The same targets, 100 m from where the photos' GPS is."""
        transforms = wire.Heard("/tf", TFMessage)
        self.addCleanup(transforms.close)
        path = self.move_to_austria("austria.csv", 100.0)
        answer = self.load(path, crs="EPSG:31256", heights="ellipsoidal")
        self.assertTrue(answer.success, answer.message)
        placed = self.wait_for(lambda g: g.survey == str(path) and g.is_on_earth, "Austria")
        self.assertEqual(placed.source, "targets")
        self.assertIn("gps_disagrees", codes(placed))
        transforms.wait(
            lambda heard: any((t.header.frame_id, t.child_frame_id) == ("earth", "enu") and
                              t.transform == placed.earth_from_enu
                              for message in heard for t in message.transforms), "earth to enu")
        place = placed.earth_from_enu.translation
        # 5213.6 km from the equator along Bessel's meridian is 47.058 degrees north.
        self.assertAlmostEqual(numpy.hypot(place.x, place.y), 6389.6e3 * numpy.cos(0.8213),
                               delta=2e3)

    def test_a_flight_is_placed_while_it_is_flown_and_the_mapper_is_told(self):
        scales = self.hear("metres_per_map_unit", Float64)
        drawings = self.hear("targets", MarkerArray)
        points = self.hear("control_points", ControlPoints)
        transforms = wire.Heard("/tf", TFMessage)
        self.addCleanup(transforms.close)
        self.fly(survey=self.world / "survey.csv")
        self.leave(self.photos)
        self.wait_for_verdicts(NUM_PHOTOS)
        placed = self.wait_for_all_targets()
        for target in placed.targets:
            self.assertLess(target.error_mm, 15.0)  # Photos of 7 mm a pixel, not yet bundled.
        self.assertFalse(placed.is_coarse)
        self.assertEqual(placed.survey, str(self.world / "survey.csv"))
        self.assertGreater(placed.num_gps_photos, 3)

        scale = scales.wait(lambda heard: any(s.data > 0.0 for s in heard), "the scale")[-1].data
        self.assertAlmostEqual(scale, placed.metres_per_map_unit, delta=0.02 * scale)
        drawing = drawings.wait(len, "the targets drawn")[-1]
        self.assertEqual({marker.header.frame_id for marker in drawing.markers}, {"map"})
        transforms.wait(
            lambda heard: any((t.header.frame_id, t.child_frame_id) == ("enu", "map")
                              for message in heard for t in message.transforms), "enu to map")
        surveyed = points.wait(
            lambda heard: any(sum(p.is_surveyed for p in message.points) == placed.num_control
                              for message in heard), "the control points")[-1]
        self.assertTrue(all(len(set(point.photos)) == len(point.photos) >= 2
                            for point in surveyed.points))

    def test_a_survey_is_replaced_in_flight_and_a_broken_one_stops_nothing(self):
        broken = self.write_survey("broken.csv", self.survey)
        broken.write_text(broken.read_text().replace(self.survey[2]["y_m"], "far away"))
        flight = self.fly(survey=broken)
        self.leave(self.photos[:5])
        self.wait_for_verdicts(5)
        bad = self.wait_for(lambda g: "bad_survey" in codes(g), "what is wrong with the survey")
        self.assertIn("line 4", bad.findings[0].text)
        self.assertEqual(bad.survey, "")

        answer = self.load(self.world / "survey.csv")
        self.assertTrue(answer.success, answer.message)
        self.assertIn("control", answer.message)
        self.wait_for(lambda g: g.source == "targets" and "bad_survey" not in codes(g), "targets")

        for path, words in ((broken, "line 4"), (self.folder / "none.csv", "none.csv"),
                            ("survey.csv", "absolute")):
            answer = self.load(path)
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)
            self.assertIn("stays in use", answer.message)
        self.assertFalse(self.load(self.world / "survey.csv", crs="EPSG:1").success)
        self.leave(self.photos[5:])
        self.wait_for_verdicts(NUM_PHOTOS)
        self.wait_for_all_targets()

        self.load_what_does_not_place()
        path, ids = self.swapped()
        self.assertTrue(self.load(path).success)
        wrong = self.wait_for(lambda g: g.survey == str(path), "the other survey")
        self.assertEqual({target for target, state in states(wrong).items() if state == "wrong"},
                         ids)
        self.assertIn("exchanged_targets", codes(wrong))

        self.load_elsewhere()
        self.load_on_earth()
        self.assertTrue(self.load("").success)
        self.wait_for(lambda g: g.survey == "" and g.source == "gps" and g.is_coarse, "GPS alone")
        self.assertIsNone(flight.poll())

    def test_nodes_killed_in_flight_give_the_same(self):
        self.fly(survey=self.folder / "not_yet.csv")
        self.leave(self.photos[:4])
        self.wait_for_verdicts(4)
        self.assertTrue(self.load(self.world / "survey.csv").success)
        kill_node("/plumbline/georeferencer")
        kill_node("/plumbline/marker_detector")
        self.leave(self.photos[4:])
        self.wait_for_verdicts(NUM_PHOTOS)
        before = self.wait_for_settled()
        self.georeferences.close()
        kill_node("/plumbline/georeferencer")
        self.georeferences = self.hear("georeference", Georeference)
        after = self.wait_for_settled()
        self.assertEqual(after.survey, str(self.world / "survey.csv"))
        if after.map_sequence == before.map_sequence:
            for target, residual in residuals(before).items():
                numpy.testing.assert_allclose(residuals(after)[target], residual, atol=1e-6)

        killed = rospy.Time.now()
        kill_node("/plumbline/mapper")
        diagnostics = wire.Diagnostics()
        self.addCleanup(diagnostics.close)
        after = self.wait_for(lambda g: g.header.stamp > killed and states(g) == states(before),
                              "the same after a restart of the mapper")
        diagnostics.wait(
            lambda heard: any(value.key == "control points of the bundle" and
                              value.value == str(after.num_control) for message in heard
                              for status in message.status for value in status.values),
            "the control points in the mapper again")
        detections = rospy.ServiceProxy("/plumbline/get_marker_detections", GetMarkerDetections)()
        self.assertEqual([answer.sequence for answer in detections.answers],
                         list(range(1, NUM_PHOTOS + 1)))
        self.assertEqual({answer.reason for answer in detections.answers}, {""})

    def test_nonsense_on_the_wire_changes_nothing(self):
        flight = self.fly(survey=self.world / "survey.csv")
        self.leave(self.photos)
        self.wait_for_verdicts(NUM_PHOTOS)
        before = self.finish()

        def publish(topic, *messages):
            publisher = rospy.Publisher(f"/plumbline/{topic}", type(messages[0]), queue_size=10)
            wire.wait_until(publisher.get_num_connections, f"a listener of {topic}")
            for message in messages:
                publisher.publish(message)
        nan = MarkerDetection(id=1, center_px=[NAN, 1.0])
        publish("marker_detections", MarkerDetectionArray(sequence=1, detections=[nan]),
                MarkerDetectionArray(sequence=0), MarkerDetectionArray(sequence=2 ** 32 - 1),
                MarkerDetectionArray(sequence=77, detections=[MarkerDetection(id=4000)]))
        publish("photo_positions", PhotoPositions(sequences=[1]),
                PhotoPositions(sequences=[1, 2], lats_deg=[NAN, 1e9], lons_deg=[0.0, 0.0],
                               alts_ellipsoid_m=[0.0, 0.0]))
        publish("map_delta", MapDelta(sequence=10 ** 6, lens=[NAN] * 12),
                MapDelta(sequence=10 ** 6, landmarks_removed=[5], views_removed=[1]))
        publish("control_points", ControlPoints(points=[ControlPoint(position_in_map=[NAN] * 3)]))
        num_before = len(self.georeferences.all())
        self.assertTrue(self.load(self.world / "survey.csv").success)
        after = self.wait_for_all_targets(num_before)
        self.assertEqual(after.map_sequence, before.map_sequence)
        self.assertEqual(states(after), states(before))
        for target, residual in residuals(after).items():
            numpy.testing.assert_allclose(residual, residuals(before)[target], atol=1e-6)
        self.assertIsNone(flight.poll())


if __name__ == "__main__":
    rospy.init_node("georeference_test")
    rostest.rosrun("plumbline", "georeference", GeoreferenceTest)
