// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/surface_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "plumbline/surface/mesh_replica.h"
#include "test/surface/equal_meshes.h"
#include "test/surface/random_map.h"
#include "test/surface/simple_maps.h"

namespace plumb {
namespace {

using test::ExpectSameMesh;
using test::RandomMap;
using test::SimpleMap;
using testing::IsEmpty;
using testing::SizeIs;

SurfaceOptions SmallOptions() {
  SurfaceOptions options;
  options.min_island_faces = 3;
  options.max_edge_ratio = 1.0;  // The maps of these tests have few landmarks.
  return options;
}

SurfaceUpdate MeshOf(const MapDelta& delta, const SurfaceOptions& options = SmallOptions()) {
  SurfaceMesher mesher(options);
  return mesher.Apply(delta).value();
}

// What the deltas tell is what the mesher has, and what one has that starts from the map.
TEST(SurfaceMesher, HasTheSameMeshWhetherRestartedOrNot) {
  RandomMap::Options options;
  options.num_landmarks = 120;
  options.num_views = 12;
  options.num_changes = 6;
  options.seed = 5;
  RandomMap map(options);
  SurfaceOptions surface = SmallOptions();
  surface.alpha_occ = 256;  // Three rays a landmark: little lies behind it.
  SurfaceMesher mesher(surface);
  MeshReplica replica;
  std::size_t max_num_faces = 0;
  for (int step = 0; step < 400; ++step) {
    const auto update = mesher.Apply(map.delta());
    ASSERT_TRUE(update.has_value());
    ASSERT_TRUE(replica.Apply(update->mesh));
    max_num_faces = std::max(max_num_faces, replica.num_faces());
    ExpectSameMesh(replica.Snapshot(), mesher.Snapshot());
    ExpectSameMesh(replica.Snapshot(), MeshOf(map.replica().Snapshot(), surface).mesh);
    if (HasFatalFailure()) FAIL() << "step " << step;
    map.Change();
  }
  EXPECT_GT(max_num_faces, 50U);
  surface.max_spike_ratio = 100.0;  // Some of what came and went were spikes.
  EXPECT_GT(MeshOf(map.replica().Snapshot(), surface).report.num_faces, replica.num_faces());
}

TEST(SurfaceMesher, HasTheSameMeshWithAnyNumberOfThreads) {
  RandomMap::Options options;
  options.num_landmarks = 1000;  // So many that each thread has some.
  options.num_views = 12;
  options.num_changes = 200;
  options.seed = 8;
  RandomMap map(options);
  SurfaceOptions surface = SmallOptions();
  surface.alpha_occ = 256;
  surface.num_threads = 1;
  SurfaceMesher alone(surface);
  surface.num_threads = 4;
  SurfaceMesher shared(surface);
  int num_large = 0;  // Steps with landmarks for several threads.
  for (int step = 0; step < 40; ++step) {
    const auto expected = alone.Apply(map.delta());
    const auto update = shared.Apply(map.delta());
    ASSERT_TRUE(expected && update);
    if (update->report.num_rays_cast > 1000) ++num_large;
    EXPECT_EQ(update->report.num_rays_cast, expected->report.num_rays_cast);
    EXPECT_EQ(update->mesh.blocks, expected->mesh.blocks);
    EXPECT_EQ(update->mesh.faces_added, expected->mesh.faces_added);
    EXPECT_EQ(update->mesh.faces_removed, expected->mesh.faces_removed);
    map.Change();
  }
  EXPECT_GE(num_large, 20);
  EXPECT_GT(alone.Snapshot().faces_added.size(), 300U);
}

TEST(SurfaceMesher, GoesOnAfterARestartAsIfThereHadBeenNone) {
  RandomMap map({/*num_landmarks=*/80, /*num_views=*/8, /*num_changes=*/5, /*seed=*/6});
  SurfaceMesher mesher(SmallOptions());
  std::unique_ptr<SurfaceMesher> restarted;
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(mesher.Apply(map.delta()).has_value());
    if (step % 20 == 10) {
      restarted = std::make_unique<SurfaceMesher>(SmallOptions());
      ASSERT_TRUE(restarted->Apply(map.replica().Snapshot()).has_value());
    } else if (restarted != nullptr) {
      ASSERT_TRUE(restarted->Apply(map.delta()).has_value());
    }
    if (restarted != nullptr) ExpectSameMesh(restarted->Snapshot(), mesher.Snapshot());
    if (HasFatalFailure()) FAIL() << "step " << step;
    map.Change();
  }
}

// Faces that are named as new or gone are those and no others, and blocks that did not change stay
// at home.
TEST(SurfaceMesher, SendsWhatChangedAndNothingElse) {
  RandomMap map({/*num_landmarks=*/150, /*num_views=*/10, /*num_changes=*/2, /*seed=*/7});
  SurfaceMesher mesher(SmallOptions());
  MeshReplica replica;
  for (int step = 0; step < 200; ++step) {
    const MeshDelta before = replica.Snapshot();
    const MeshDelta delta = mesher.Apply(map.delta())->mesh;
    for (const MeshBlock& block : delta.blocks) {
      const auto old = replica.blocks().find(block.id);
      if (old == replica.blocks().end()) {
        ASSERT_FALSE(block.faces.empty());
      } else {
        ASSERT_FALSE(old->second == block);
      }
    }
    ASSERT_TRUE(replica.Apply(delta));
    std::set<FaceKey> keys(before.faces_added.begin(), before.faces_added.end());
    for (const FaceKey& key : delta.faces_removed) ASSERT_EQ(keys.erase(key), 1U);
    for (const FaceKey& key : delta.faces_added) ASSERT_TRUE(keys.insert(key).second);
    const MeshDelta after = replica.Snapshot();
    ASSERT_EQ(keys, std::set<FaceKey>(after.faces_added.begin(), after.faces_added.end()));
    map.Change();
  }
}

TEST(SurfaceMesher, AsksForASnapshotAfterAGap) {
  RandomMap map({/*num_landmarks=*/60, /*num_views=*/6, /*num_changes=*/3, /*seed=*/8});
  SurfaceMesher mesher(SmallOptions());
  ASSERT_TRUE(mesher.Apply(map.delta()).has_value());
  map.Change();
  map.Change();
  EXPECT_FALSE(mesher.Apply(map.delta()).has_value());
  EXPECT_EQ(mesher.map_sequence(), 1U);
  const auto update = mesher.Apply(map.replica().Snapshot());
  ASSERT_TRUE(update.has_value());
  EXPECT_TRUE(update->mesh.is_snapshot);
  EXPECT_EQ(update->mesh.sequence, 2U);
  EXPECT_EQ(update->mesh.map_sequence, 3U);
}

// A wall with nothing behind it, after the first two photos: it is there, though half of its
// landmarks are seen through by the other half's rays.
TEST(SurfaceMesher, AWallIsThereFromItsFirstTwoPhotosOn) {
  EXPECT_GT(MeshOf(SimpleMap::WallSeenBy(2).Snapshot()).report.num_faces, 300U);
  EXPECT_GT(MeshOf(SimpleMap::WallSeenBy(3).Snapshot()).report.num_faces, 300U);
}

// A wall seen by two rows of cameras: nothing closes it at the back.
TEST(SurfaceMesher, KeepsTheWallAndNotWhatClosesItBehind) {
  const SimpleMap wall = SimpleMap::Wall();
  const SurfaceUpdate update = MeshOf(wall.Snapshot());
  ASSERT_GT(update.report.num_faces, 300U);
  double towards_cameras_m2 = 0.0;
  double away_m2 = 0.0;
  for (const MeshBlock& block : update.mesh.blocks) {
    for (const std::array<std::uint32_t, 3>& face : block.faces) {
      const Eigen::Vector3d& a = block.vertices[face[0]].position_in_map;
      const Eigen::Vector3d& b = block.vertices[face[1]].position_in_map;
      const Eigen::Vector3d& c = block.vertices[face[2]].position_in_map;
      const double area_m2 = -0.5 * (b - a).cross(c - a).y();
      (area_m2 > 0.0 ? towards_cameras_m2 : away_m2) += std::abs(area_m2);
      for (const Eigen::Vector3d& corner : {a, b, c}) EXPECT_LT(std::abs(corner.y()), 0.02);
    }
  }
  EXPECT_GT(towards_cameras_m2, 0.9 * 8.0);
  EXPECT_LT(away_m2, 0.01 * 8.0);  // Where noise folds it.
}

std::size_t NumFacesAt(LandmarkId landmark, const SurfaceMesher& mesher) {
  const std::vector<FaceKey> faces = mesher.Snapshot().faces_added;
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [&](const FaceKey& key) {
        return std::find(key.begin(), key.end(), landmark) != key.end();
      }));
}

// 10 cm before the wall, seen from 4 m.
TEST(SurfaceMesher, BelievesAStepWhenAThirdPhotoShowsIt) {
  const SimpleMap wall = SimpleMap::Wall();
  MapDelta delta = wall.Snapshot();
  const auto middle = std::min_element(delta.landmarks_set.begin(),
                                       delta.landmarks_set.end(),
                                       [](const LandmarkState& a, const LandmarkState& b) {
                                         const Eigen::Vector3d center(2, 0, 1);
                                         return (a.position_in_map - center).norm() <
                                                (b.position_in_map - center).norm();
                                       });
  const LandmarkId step = middle->id;
  const Eigen::Vector3d on_wall = middle->position_in_map;
  middle->position_in_map.y() -= 0.1;
  std::vector<ObservationState>& rays = delta.observations_added;
  rays.erase(std::remove_if(rays.begin(),
                            rays.end(),
                            [&](const ObservationState& ray) {
                              return ray.landmark == step && ray.photo.value >= 2;
                            }),
             rays.end());
  SurfaceOptions options = SmallOptions();
  options.alpha_occ = 1000;  // Its few rays against those through it, of its neighbours.
  SurfaceMesher mesher(options);
  ASSERT_TRUE(mesher.Apply(delta).has_value());
  EXPECT_EQ(NumFacesAt(step, mesher), 0U);

  MapDelta third;
  third.sequence = 2;
  third.observations_added = {{step, PhotoId{2}, step.value, {0, 0}}};
  ASSERT_TRUE(mesher.Apply(third).has_value());
  EXPECT_GE(NumFacesAt(step, mesher), 3U);

  MapDelta gone;
  gone.sequence = 3;
  gone.observations_removed = third.observations_added;
  ASSERT_TRUE(mesher.Apply(gone).has_value());
  EXPECT_EQ(NumFacesAt(step, mesher), 0U);

  MapDelta moved;
  moved.sequence = 4;
  moved.landmarks_set = {{step, on_wall, {0, 0, 0}}};
  ASSERT_TRUE(mesher.Apply(moved).has_value());
  EXPECT_GE(NumFacesAt(step, mesher), 3U);
}

TEST(SurfaceMesher, MovesWithinTheLatticeChangeNoTetrahedra) {
  SimpleMap wall = SimpleMap::Wall();
  SurfaceMesher mesher(SmallOptions());
  ASSERT_TRUE(mesher.Apply(wall.Snapshot()).has_value());
  MapDelta delta;
  delta.sequence = 2;
  delta.landmarks_set = wall.landmarks();
  for (LandmarkState& landmark : delta.landmarks_set) landmark.position_in_map.x() += 1e-7;
  const SurfaceReport report = mesher.Apply(delta)->report;
  EXPECT_EQ(report.num_landmarks_moved, wall.landmarks().size());
  EXPECT_LE(report.num_landmarks_reinserted, 1U);
}

TEST(SurfaceMesher, IsRebuiltWhenTheWholeMapMoves) {
  SimpleMap wall = SimpleMap::Wall();
  SurfaceMesher mesher(SmallOptions());
  MeshReplica replica;
  ASSERT_TRUE(replica.Apply(mesher.Apply(wall.Snapshot())->mesh));
  wall.Move({1.5, 0.25, 0.125});
  MapDelta delta = wall.Snapshot();
  delta.is_snapshot = false;
  delta.sequence = 2;
  delta.observations_added.clear();
  const auto update = mesher.Apply(delta);
  EXPECT_TRUE(update->report.is_rebuilt);
  ASSERT_TRUE(replica.Apply(update->mesh));
  ExpectSameMesh(replica.Snapshot(), MeshOf(wall.Snapshot()).mesh);
}

TEST(SurfaceMesher, TakesMapsWithoutDepth) {
  for (const SimpleMap& map : {SimpleMap::Line(),
                               SimpleMap::FlatWall(),
                               SimpleMap::FirstOf(4),
                               SimpleMap::FirstOf(3),
                               SimpleMap::FirstOf(1),
                               SimpleMap::FirstOf(0)}) {
    EXPECT_NO_THROW(MeshOf(map.Snapshot()));
  }
}

TEST(SurfaceMesher, LosesAndRegainsItsDepth) {
  const SimpleMap four = SimpleMap::FirstOf(4);
  SurfaceMesher mesher(SmallOptions());
  ASSERT_TRUE(mesher.Apply(four.Snapshot()).has_value());
  MapDelta gone;
  gone.sequence = 2;
  for (const LandmarkState& landmark : four.landmarks())
    gone.landmarks_removed.push_back(landmark.id);
  EXPECT_EQ(mesher.Apply(gone)->report.num_cells, 0U);
  MapDelta back = four.Snapshot();
  back.is_snapshot = false;
  back.sequence = 3;
  EXPECT_EQ(mesher.Apply(back)->report.num_cells, 1U);
}

TEST(SurfaceMesher, NamesWhatItCannotUse) {
  SimpleMap wall = SimpleMap::Wall();
  MapDelta delta = wall.Snapshot();
  const SurfaceUpdate clean = MeshOf(delta);
  EXPECT_THAT(clean.report.problems, IsEmpty());

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto add = [&](std::uint32_t id, const Eigen::Vector3d& position) {
    delta.landmarks_set.push_back({LandmarkId{id}, position, {0, 0, 0}});
    for (const std::uint32_t photo : {0U, 1U}) {
      delta.observations_added.push_back({LandmarkId{id}, PhotoId{photo}, id, {0, 0}});
    }
  };
  add(90001, {nan, 0, 0});
  add(90002, {1e200, 0, 0});
  add(90003, wall.landmarks()[5].position_in_map);
  add(90004, wall.CenterOf(0));
  ViewState broken;
  broken.photo = PhotoId{777};
  broken.cam_from_map.translation.x() = nan;
  delta.views_set.push_back(broken);
  delta.observations_added.push_back({LandmarkId{90005}, PhotoId{0}, 1, {0, 0}});
  delta.observations_added.push_back({wall.landmarks()[0].id, PhotoId{778}, 1, {0, 0}});

  SurfaceMesher mesher(SmallOptions());
  std::vector<std::string> said;
  const SurfaceUpdate update = mesher.Apply(delta).value();
  for (const SurfaceProblem& problem : update.report.problems) {
    said.push_back(Describe(problem));
  }
  EXPECT_THAT(said,
              testing::UnorderedElementsAre(testing::StartsWith("landmark 90001: its position"),
                                            testing::StartsWith("landmark 90002: its position"),
                                            "landmark 90003: exactly where landmark 5 is",
                                            testing::StartsWith("landmark 90004: exactly where the "
                                                                "camera of photo 0 is"),
                                            testing::StartsWith("photo 777: its pose"),
                                            testing::StartsWith("landmark 90005: photo 0"),
                                            testing::StartsWith("photo 778: ")));
}

TEST(SurfaceMesher, TakesBackALandmarkThatBecomesUsable) {
  SimpleMap wall = SimpleMap::Wall();
  MapDelta delta = wall.Snapshot();
  delta.landmarks_set[7].position_in_map.x() = std::numeric_limits<double>::infinity();
  SurfaceMesher mesher(SmallOptions());
  ASSERT_TRUE(mesher.Apply(delta).has_value());
  MapDelta repair;
  repair.sequence = 2;
  repair.landmarks_set = {wall.landmarks()[7]};
  ASSERT_TRUE(mesher.Apply(repair).has_value());
  ExpectSameMesh(mesher.Snapshot(), MeshOf(wall.Snapshot()).mesh);
}

TEST(SurfaceMesher, CutsTheMeshIntoBlocksOfAMetre) {
  SurfaceOptions options = SmallOptions();
  options.block_side = 0.25;
  const MeshDelta mesh = MeshOf(SimpleMap::Wall().Snapshot(), options).mesh;
  ASSERT_GT(mesh.blocks.size(), 100U);
  for (const MeshBlock& block : mesh.blocks) {
    for (const std::array<std::uint32_t, 3>& face : block.faces) {
      Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
      for (const std::uint32_t corner : face)
        centroid += block.vertices[corner].position_in_map / 3;
      EXPECT_LT(
          (centroid - Eigen::Vector3d(block.id.x + 0.5, block.id.y + 0.5, block.id.z + 0.5) / 4)
              .cwiseAbs()
              .maxCoeff(),
          0.125 + 1e-9);
    }
  }
}

TEST(SurfaceMesher, RefusesOptionsOutOfBounds) {
  SurfaceOptions options;
  options.alpha_free = -1;
  options.block_side = 0.0;
  EXPECT_THAT(options.Problems(), SizeIs(2));
  EXPECT_THROW(SurfaceMesher{options}, std::invalid_argument);
  EXPECT_THAT(SurfaceOptions().Problems(), IsEmpty());
}

}  // namespace
}  // namespace plumb
