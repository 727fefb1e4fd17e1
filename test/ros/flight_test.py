#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""flight.launch and replay.launch with photos of a real facade."""

import os
import signal
import subprocess
import unittest

import rosgraph
import rosnode
import rospy
import rostest
from plumbline.msg import MapDelta, Photo, PhotoVerdict
from plumbline.srv import GetMap
from std_srvs.srv import Trigger
from xmlrpc.client import ServerProxy

import wire

NUM_PHOTOS = 4

REASON_OF_BAD_FILE = {"empty.jpg": "undecodable", "text.jpg": "undecodable",
                      "again.jpg": "duplicate", "cut.jpg": "undecodable",
                      "dot.png": "wrong_size", "small.jpg": "wrong_size"}


def latest(verdicts):
    """Status and reason of each photo by its latest verdict."""
    by_name = {}
    for verdict in verdicts:
        by_name[verdict.name] = (verdict.status, verdict.reason)
    return by_name


def kill_node(name):
    """Ends a node by SIGKILL, as a crash would."""
    master = rosgraph.Master("/flight_test")
    _, _, process_id = ServerProxy(master.lookupNode(name)).getPid("/flight_test")
    os.kill(process_id, signal.SIGKILL)


class Replica:
    """The map as its deltas tell it."""

    def __init__(self):
        self.views, self.landmarks, self.observations = {}, {}, set()

    def apply(self, delta):
        if delta.is_snapshot:
            self.__init__()
        gone = delta.observations_removed
        self.observations -= set(zip(gone.landmarks, gone.photos, gone.feature_idxs))
        landmarks_gone, views_gone = set(delta.landmarks_removed), set(delta.views_removed)
        self.observations = {row for row in self.observations
                             if row[0] not in landmarks_gone and row[1] not in views_gone}
        for landmark in landmarks_gone:
            self.landmarks.pop(landmark, None)
        for view in views_gone:
            self.views.pop(view, None)
        for view in delta.views_set:
            pose = view.cam_from_map
            self.views[view.photo] = (view.name, pose.translation.x, pose.rotation.w)
        rows = delta.landmarks_set
        for i, landmark in enumerate(rows.ids):
            self.landmarks[landmark] = tuple(rows.positions_in_map[3 * i:3 * i + 3])
        new = delta.observations_added
        self.observations |= set(zip(new.landmarks, new.photos, new.feature_idxs))

    @classmethod
    def of(cls, deltas):
        replica = cls()
        for delta in deltas:
            replica.apply(delta)
        return replica

    def names(self):
        return {view[0] for view in self.views.values()}

    def content(self):
        return self.views, self.landmarks, self.observations


class FlightTest(wire.FolderTest):
    def setUp(self):
        scene = wire.shared_data("fountain-P11")
        super().setUp()
        photos = sorted((scene / "photos").iterdir())
        self.source, self.others = photos[:NUM_PHOTOS], photos[NUM_PHOTOS:]
        self.camera = scene / "camera.yaml"
        self.verdicts = wire.Heard("/plumbline/photo_verdict", PhotoVerdict)
        self.deltas = wire.Heard("/plumbline/map_delta", MapDelta)
        self.addCleanup(self.verdicts.close)
        self.addCleanup(self.deltas.close)

    def launch(self, file, **arguments):
        process = subprocess.Popen(
            ["roslaunch", "--no-summary", "plumbline", file, "rviz:=false"] +
            [f"{key}:={value}" for key, value in arguments.items()])
        self.addCleanup(self.stop, process)
        return process

    @staticmethod
    def stop(process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            process.wait(wire.DEADLINE_S)

    def fly(self, **arguments):
        return self.launch("flight.launch", photos=self.card, session=self.session,
                           camera=self.camera, **arguments)

    def leave(self, name, data):
        (self.card / name).write_bytes(data)

    def wait_for_verdicts(self, names):
        return self.verdicts.wait(lambda heard: set(names) <= {v.name for v in heard},
                                  f"a verdict of each of {sorted(names)}")

    def wait_for_accepted(self, names):
        def all_accepted(heard):
            verdicts = latest(heard)
            return all(verdicts.get(name) == ("accepted", "none") for name in names)
        return self.verdicts.wait(all_accepted, f"'accepted' of {sorted(names)}")

    def leave_converted(self, photo, name, *options):
        """Leaves a photo as ImageMagick makes it of another."""
        made = self.folder / name
        subprocess.run(["convert", str(photo), *options, str(made)], check=True)
        made.rename(self.card / name)

    def leave_odd_photos(self):
        self.leave("cut.jpg", self.others[0].read_bytes()[:500000])
        self.leave_converted(self.source[0], "dot.png", "-resize", "1x1!")
        self.leave_converted(self.source[0], "small.jpg", "-resize", "50%")
        self.leave_converted(self.others[0], "grey.jpg", "-colorspace", "Gray")
        self.leave_converted(self.others[1], "deep.png", "-colorspace", "Gray", "-quality", "10",
                             "-define", "png:bit-depth=16")

    def leave_photos_and_bad_files(self):
        self.leave("empty.jpg", b"")
        self.leave("text.jpg", b"this is no photo")
        for photo in self.source:
            self.leave(photo.name, photo.read_bytes())
            self.wait_for_verdicts([photo.name])
        self.leave("again.jpg", self.source[0].read_bytes())
        self.leave_odd_photos()

    def test_verdicts_deltas_and_snapshot_agree_and_a_replay_gives_the_same(self):
        flight = self.fly(record="true")
        self.leave_photos_and_bad_files()
        names = [photo.name for photo in self.source] + ["grey.jpg", "deep.png"]
        self.wait_for_accepted(names)
        self.wait_for_verdicts(REASON_OF_BAD_FILE)
        self.assertTrue(rospy.ServiceProxy("/plumbline/finish", Trigger)().success)
        verdicts = latest(self.verdicts.all())
        for name, reason in REASON_OF_BAD_FILE.items():
            self.assertEqual(verdicts[name], ("refused", reason), name)
        self.assertTrue((self.session / "report.json").exists())

        snapshot = rospy.ServiceProxy("/plumbline/get_map", GetMap)().snapshot
        deltas = self.deltas.wait(
            lambda heard: heard and heard[-1].sequence >= snapshot.sequence, "the last delta")
        deltas = [delta for delta in deltas if delta.sequence <= snapshot.sequence]
        self.assertEqual([delta.sequence for delta in deltas], list(range(1, len(deltas) + 1)))
        accumulated, expected = Replica.of(deltas), Replica.of([snapshot])
        self.assertEqual(accumulated.content(), expected.content())
        self.assertEqual(expected.names(), set(names))

        self.stop(flight)
        self.verdicts.close()
        self.verdicts = wire.Heard("/plumbline/photo_verdict", PhotoVerdict)
        self.launch("replay.launch", bag=self.session / "flight.bag",
                    session=self.folder / "replay")
        self.wait_for_accepted(names)
        self.wait_for_verdicts(verdicts)
        self.assertEqual(latest(self.verdicts.all()), verdicts)

    def test_a_flight_with_blanks_in_its_path_goes_on_when_the_recorder_is_killed(self):
        self.session = self.folder / "flight 3 of today"
        flight = self.fly(record="true")
        first, rest = self.source[:2], self.source[2:]
        for photo in first:
            self.leave(photo.name, photo.read_bytes())
        self.wait_for_accepted([photo.name for photo in first])
        kill_node([name for name in rosnode.get_node_names() if "record_flight" in name][0])
        for photo in rest:
            self.leave(photo.name, photo.read_bytes())
        self.wait_for_accepted([photo.name for photo in self.source])
        wire.wait_until(lambda: (self.session / "flight_1.bag.active").exists() and
                        (self.session / "flight.bag.active").exists(), "a second recording")
        self.stop(flight)
        self.assertTrue((self.session / "flight.bag").exists())

    def test_a_killed_mapper_goes_on_with_the_map_it_had(self):
        self.fly()
        first, rest = self.source[:3], self.source[3:]
        for photo in first:
            self.leave(photo.name, photo.read_bytes())
        self.wait_for_accepted([photo.name for photo in first])
        kill_node("/plumbline/mapper")
        for photo in rest:
            self.leave(photo.name, photo.read_bytes())
        self.wait_for_accepted([photo.name for photo in self.source])
        names = {photo.name for photo in self.source}
        # Views follow their verdicts, and one accepted just before the kill may come again last.
        self.deltas.wait(lambda heard: Replica.of(heard).names() == names, "the views of all")
        snapshot = rospy.ServiceProxy("/plumbline/get_map", GetMap)().snapshot
        self.assertEqual({view.name for view in snapshot.views_set}, names)
        self.assertEqual([view.photo for view in snapshot.views_set], [1, 2, 3, 4])

    def test_a_killed_ingest_goes_on_counting(self):
        photos = wire.Heard("/plumbline/photo", Photo)
        self.addCleanup(photos.close)
        self.fly()
        self.leave(self.source[0].name, self.source[0].read_bytes())
        self.wait_for_verdicts([self.source[0].name])
        kill_node("/plumbline/camera_ingest")
        self.leave(self.source[1].name, self.source[1].read_bytes())
        self.wait_for_accepted([photo.name for photo in self.source[:2]])
        numbers = {photo.name: photo.sequence for photo in photos.all()}
        self.assertEqual(numbers, {self.source[0].name: 1, self.source[1].name: 2})


if __name__ == "__main__":
    rospy.init_node("flight_test")
    rostest.rosrun("plumbline", "flight", FlightTest)
