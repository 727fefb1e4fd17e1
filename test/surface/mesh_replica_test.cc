// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/mesh_replica.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "test/surface/equal_meshes.h"

namespace plumb {
namespace {

MeshBlock MakeBlock(std::int32_t x, std::uint32_t first_landmark, std::size_t num_faces) {
  MeshBlock block;
  block.id = {x, 0, 0};
  for (std::uint32_t i = 0; i < num_faces + 2; ++i) {
    block.vertices.push_back({{first_landmark + i}, Eigen::Vector3d(x, i, 0), {1, 2, 3}});
  }
  for (std::uint32_t i = 0; i < num_faces; ++i) block.faces.push_back({i, i + 1, i + 2});
  return block;
}

MeshDelta MakeDelta(std::uint32_t sequence, std::vector<MeshBlock> blocks) {
  MeshDelta delta;
  delta.sequence = sequence;
  delta.map_sequence = 10 + sequence;
  delta.blocks = std::move(blocks);
  return delta;
}

TEST(MeshReplica, HoldsTheBlocksAsTheyWereSentLast) {
  MeshReplica replica;
  ASSERT_TRUE(replica.Apply(MakeDelta(1, {MakeBlock(0, 0, 4), MakeBlock(1, 100, 2)})));
  ASSERT_TRUE(replica.Apply(MakeDelta(2, {MakeBlock(0, 50, 1), MakeBlock(2, 200, 3)})));
  ASSERT_TRUE(replica.Apply(MakeDelta(3, {MakeBlock(1, 0, 0)})));  // Gone.
  EXPECT_EQ(replica.num_faces(), 4U);
  EXPECT_EQ(replica.sequence(), 3U);
  EXPECT_EQ(replica.map_sequence(), 13U);
  ASSERT_EQ(replica.blocks().size(), 2U);
  EXPECT_TRUE(replica.blocks().at({0, 0, 0}) == MakeBlock(0, 50, 1));
}

TEST(MeshReplica, RefusesAGapAndTakesASnapshot) {
  MeshReplica replica;
  ASSERT_TRUE(replica.Apply(MakeDelta(1, {MakeBlock(0, 0, 4)})));
  EXPECT_FALSE(replica.Apply(MakeDelta(3, {})));
  EXPECT_EQ(replica.num_faces(), 4U);
  MeshDelta snapshot = MakeDelta(7, {MakeBlock(5, 9, 2)});
  snapshot.is_snapshot = true;
  EXPECT_TRUE(replica.Apply(snapshot));
  EXPECT_EQ(replica.num_faces(), 2U);
  EXPECT_TRUE(replica.Apply(MakeDelta(8, {})));
}

TEST(MeshReplica, TellsALateListenerTheWhole) {
  MeshReplica replica;
  ASSERT_TRUE(replica.Apply(MakeDelta(1, {MakeBlock(3, 7, 2), MakeBlock(-2, 0, 1)})));
  const MeshDelta snapshot = replica.Snapshot();
  EXPECT_TRUE(snapshot.is_snapshot);
  MeshReplica late;
  ASSERT_TRUE(late.Apply(snapshot));
  test::ExpectSameMesh(late.Snapshot(), snapshot);
  const std::vector<FaceKey> expected = {{{{0}, {1}, {2}}}, {{{7}, {8}, {9}}}, {{{8}, {9}, {10}}}};
  EXPECT_EQ(snapshot.faces_added, expected);
}

}  // namespace
}  // namespace plumb
