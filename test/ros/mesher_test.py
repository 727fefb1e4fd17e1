#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesher on the wire: deltas and snapshots agree, a restart changes nothing, bad input neither."""

import math
import random
import unittest

import rospy
import rostest
from geometry_msgs.msg import Transform
from plumbline.msg import Gaps, MapDelta, MeshDelta, PhotoVerdict, ViewState
from plumbline.srv import GetMap, GetMapResponse, GetMesh, SetMeshDisplay
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Float64
from visualization_msgs.msg import MarkerArray

import wire

SIDE = 20  # Landmarks a side of the wall's lattice.
SPACING = 0.15


def camera_info():
    return CameraInfo(width=600, height=400, distortion_model="plumb_bob", D=[0.0] * 5,
                      K=[500.0, 0, 299.5, 0, 500.0, 199.5, 0, 0, 1])


class Wall:
    """A wall that faces -z of the map, and cameras that look along z from z = -4."""

    def __init__(self):
        numbers = random.Random(1)
        self.points = [(SPACING * (i % SIDE), SPACING * (i // SIDE), numbers.uniform(0.0, 0.02))
                       for i in range(SIDE * SIDE)]
        self.sequence = 0

    def _fill(self, delta, photos, ids):
        for photo in photos:
            pose = Transform()
            pose.rotation.w = 1.0
            pose.translation.x = -0.5 * photo
            pose.translation.y, pose.translation.z = -1.4, 4.0
            delta.views_set.append(ViewState(photo=photo, name=f"{photo}.jpg", cam_from_map=pose))
        for landmark in ids:
            delta.landmarks_set.ids.append(landmark)
            delta.landmarks_set.positions_in_map += self.points[landmark]
            delta.landmarks_set.colors_rgb += bytes([90, 90, 90])
        return delta

    @staticmethod
    def _observe(delta, photos, ids):
        rows = delta.observations_added
        for photo in photos:
            for landmark in ids:
                rows.landmarks.append(landmark)
                rows.photos.append(photo)
                rows.feature_idxs.append(landmark)
                rows.pixels_px += (1.0, 1.0)

    def delta(self, photos, ids, known_photos=(), known_ids=()):
        """The next delta: new photos, new landmarks; each photo, new or known, sees all of them."""
        self.sequence += 1
        delta = self._fill(MapDelta(sequence=self.sequence), photos, ids)
        delta.landmarks_set.colors_rgb = bytes(delta.landmarks_set.colors_rgb)
        self._observe(delta, photos, list(known_ids) + list(ids))
        self._observe(delta, known_photos, ids)
        return delta

    def snapshot(self, photos, ids):
        delta = self._fill(MapDelta(sequence=self.sequence, is_snapshot=True), photos, ids)
        self._observe(delta, photos, ids)
        return delta


def content(blocks):
    """What a mesh is, in a form that can be compared."""
    return {(block.x, block.y, block.z): (block.landmarks, block.positions_in_map, block.faces,
                                          block.gsd, block.sigma_per_px, block.num_views)
            for block in blocks if block.faces}


def replay(deltas):
    """The mesh that the deltas make."""
    mesh, sequence = {}, None
    for delta in deltas:
        assert delta.is_snapshot or sequence is None or delta.sequence == sequence + 1, "a gap"
        sequence = delta.sequence
        if delta.is_snapshot:
            mesh = {}
        for block in delta.blocks:
            mesh.pop((block.x, block.y, block.z), None)
        mesh.update(content(delta.blocks))
    return mesh


class MesherTest(unittest.TestCase):
    def setUp(self):
        self.wall = Wall()
        self.half = list(range(SIDE * SIDE // 2))
        self.rest = list(range(SIDE * SIDE // 2, SIDE * SIDE))
        self.namespace = "/" + self.id().split(".")[-1]
        self.map = MapDelta(is_snapshot=True)
        self.offer(self.map)
        self.deltas = self.publisher("map_delta", MapDelta)
        self.camera = self.publisher("session_camera", CameraInfo, latch=True)
        self.camera.publish(camera_info())
        self.heard = wire.Heard(f"{self.namespace}/mesh_delta", MeshDelta)
        self.addCleanup(self.heard.close)
        self.start()

    def publisher(self, topic, message_type, latch=False):
        publisher = rospy.Publisher(f"{self.namespace}/{topic}", message_type, queue_size=100,
                                    latch=latch)
        self.addCleanup(publisher.unregister)
        return publisher

    def offer(self, snapshot):
        """What get_map answers from now on."""
        if not hasattr(self, "server"):
            self.server = rospy.Service(f"{self.namespace}/get_map", GetMap,
                                        lambda _: GetMapResponse(snapshot=self.map))
            self.addCleanup(self.server.shutdown)
        self.map = snapshot

    def start(self, **parameters):
        self.mesher = wire.start_node("mesher", self.namespace, **parameters)
        self.addCleanup(lambda process=self.mesher: process.poll() is None and wire.end(process))
        self.heard.wait(lambda messages: any(m.is_snapshot for m in messages), "a mesh")
        wire.wait_until(self.deltas.get_num_connections, "a listener of map_delta")

    def get_mesh(self):
        service = rospy.ServiceProxy(f"{self.namespace}/get_mesh", GetMesh)
        service.wait_for_service(wire.DEADLINE_S)
        return service().snapshot

    def wait_for_map(self, sequence):
        return self.heard.wait(lambda messages: messages[-1].map_sequence == sequence,
                               f"the mesh of map {sequence}")

    def build_in_two_steps(self):
        self.deltas.publish(self.wall.delta([1, 2, 3], self.half))
        self.wait_for_map(1)
        self.deltas.publish(self.wall.delta([4, 5], self.rest, [1, 2, 3], self.half))
        self.wait_for_map(2)
        self.offer(self.wall.snapshot([1, 2, 3, 4, 5], self.half + self.rest))

    def test_deltas_and_snapshot_agree_and_views_are_counted(self):
        self.build_in_two_steps()
        snapshot = self.get_mesh()
        self.assertTrue(snapshot.is_snapshot)
        self.assertEqual(replay(self.heard.all()), content(snapshot.blocks))
        self.assertGreater(sum(len(block.faces) // 3 for block in snapshot.blocks), SIDE * SIDE)
        views = [n for block in snapshot.blocks for n in block.num_views]
        self.assertEqual(max(views), 5)
        gsd = min(value for block in snapshot.blocks for value in block.gsd)
        self.assertAlmostEqual(gsd, 4.0 / 500.0, delta=0.0002)

    def test_a_restarted_mesher_has_the_same_mesh(self):
        self.build_in_two_steps()
        before = self.get_mesh()
        self.mesher.kill()
        self.mesher.wait()
        self.mesher = wire.start_node("mesher", self.namespace)
        self.addCleanup(lambda: self.mesher.poll() is None and wire.end(self.mesher))
        self.heard.wait(lambda messages: messages[-1].is_snapshot, "the mesh after the restart")
        wire.wait_until(lambda: content(self.get_mesh().blocks) == content(before.blocks),
                        "the mesh of before")

    def test_a_missed_delta_is_caught_up_with(self):
        self.build_in_two_steps()
        expected = content(self.get_mesh().blocks)
        self.wall.sequence += 1  # One that nobody hears.
        self.offer(self.wall.snapshot([1, 2, 3, 4, 5], self.half + self.rest))
        self.deltas.publish(self.wall.delta([], []))
        self.wait_for_map(3)
        self.assertEqual(content(self.get_mesh().blocks), expected)

    def test_bad_input_leaves_the_mesh_as_it_is(self):
        self.build_in_two_steps()
        expected = content(self.get_mesh().blocks)
        bad = self.wall.delta([6], [])
        bad.views_set[0].cam_from_map.rotation.w = 0.0
        self.deltas.publish(bad)
        bad.views_set, bad.landmarks_set.ids = [], [1]
        self.deltas.publish(bad)
        wrong = camera_info()
        wrong.K = [math.nan] * 9
        self.camera.publish(wrong)
        scale = self.publisher("metres_per_map_unit", Float64, latch=True)
        scale.publish(math.nan)
        verdicts = self.publisher("photo_verdict", PhotoVerdict)
        verdicts.publish(PhotoVerdict(sequence=4000000000, status="refused", name="é\n"))
        self.offer(self.wall.snapshot([1, 2, 3, 4, 5], self.half + self.rest))
        self.deltas.publish(self.wall.delta([], []))  # After the gap that the bad ones left.
        self.wait_for_map(self.wall.sequence - 1)
        self.assertEqual(content(self.get_mesh().blocks), expected)
        self.assertIsNone(self.mesher.poll())

    def test_layers_legends_and_gaps_are_shown(self):
        self.build_in_two_steps()
        markers = wire.Heard(f"{self.namespace}/mesh_redundancy", MarkerArray)
        legend = wire.Heard(f"{self.namespace}/legend_gsd", Image)
        gaps = wire.Heard(f"{self.namespace}/gaps", Gaps)
        for heard in (markers, legend, gaps):
            self.addCleanup(heard.close)
        shown = markers.wait(len, "the whole mesh for a late listener")[0].markers
        num_faces = sum(len(block.faces) // 3 for block in self.get_mesh().blocks)
        self.assertEqual(sum(len(marker.colors) for marker in shown), num_faces)
        legend.wait(len, "a legend")
        self.assertFalse(gaps.wait(len, "gaps")[-1].is_metric)
        self.publisher("metres_per_map_unit", Float64, latch=True).publish(2.0)
        gaps.wait(lambda messages: messages[-1].is_metric, "gaps in millimetres")
        # 4 units of two metres at 500 px: 16 mm.
        display = rospy.ServiceProxy(f"{self.namespace}/set_mesh_display", SetMeshDisplay)
        self.assertTrue(display(8.0, "colour_blind").success)
        coarse = gaps.wait(lambda messages: messages[-1].wanted_gsd == 8.0 and messages[-1].gaps,
                           "gaps that are too coarse")[-1].gaps[0]
        self.assertFalse(coarse.is_unsure)
        self.assertAlmostEqual(coarse.gsd, 16.0, delta=0.8)
        self.assertIn("closer", coarse.advice)
        answer = display(4.0, "")  # From 2 m: 4 mm in the middle of the photo alone.
        self.assertFalse(answer.success)
        self.assertIn("no finer than 4.8", answer.message)
        answer = display(-1.0, "rainbow")
        self.assertFalse(answer.success)
        self.assertIn("rainbow", answer.message)
        self.assertIn("wanted_gsd_mm", answer.message)


if __name__ == "__main__":
    rospy.init_node("mesher_test")
    rostest.rosrun("plumbline", "mesher", MesherTest)
