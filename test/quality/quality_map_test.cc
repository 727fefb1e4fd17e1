// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/quality_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plumbline/simulation/facade.h"
#include "test/quality/brute_force.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using Vector = Eigen::Vector3d;

MapDelta MapOf(const std::vector<ViewState>& views) {
  MapDelta delta;
  delta.is_snapshot = true;
  delta.views_set = views;
  return delta;
}

// A wall of 8 m x 4 m in y = 0 that faces -y, with a pillar of 1 m before it. No line of sight
// passes right through an edge, where it is rounding that tells what is hidden.
test::Soup WallWithPillar() {
  test::Soup soup;
  test::AddGrid({0.0071, 0, 0.0043}, {8, 0, 0}, {0, 0, 4}, 24, 12, &soup);
  test::AddGrid({3.0, -1, 0}, {1, 0, 0}, {0, 0, 4}, 3, 12, &soup);
  test::AddGrid({3.0, 0, 0}, {0, -1, 0}, {0, 0, 4}, 3, 12, &soup);
  test::AddGrid({4.0, -1, 0}, {0, 1, 0}, {0, 0, 4}, 3, 12, &soup);
  return soup;
}

std::vector<ViewState> FlyPast(int num_photos, std::uint32_t first_photo = 1) {
  std::vector<ViewState> views;
  for (int i = 0; i < num_photos; ++i) {
    const double x = 8.0 * (i + 0.37) / num_photos;
    views.push_back(test::MakeView(
        first_photo + static_cast<std::uint32_t>(i),
        test::LookAt({x, -4.0 - 0.3 * (i % 3), 1.0 + 0.5 * (i % 4)}, {x + 0.4, 0.0, 1.9})));
  }
  return views;
}

// The simulation's facade, its large triangles cut to at most 1 m.
test::Soup TrueFacade() {
  FacadeOptions options;
  options.width_m = 8.0;
  options.height_m = 7.0;
  options.depth_m = 3.0;
  options.num_storeys = 1;
  options.balcony_share = 0.5;
  options.num_doors = 1;
  options.num_downpipes = 1;
  options.num_targets = 0;
  const World world = BuildFacade(options);
  test::Soup pieces;
  for (const WorldTriangle& triangle : world.triangles) {
    test::Soup left = {{world.vertices_in_world[triangle.vertices[0]],
                        world.vertices_in_world[triangle.vertices[1]],
                        world.vertices_in_world[triangle.vertices[2]]}};
    while (!left.empty()) {
      const test::Corners corners = left.back();
      left.pop_back();
      std::size_t longest = 0;
      for (std::size_t k = 1; k < 3; ++k) {
        const auto side = [&](std::size_t i) { return (corners[(i + 1) % 3] - corners[i]).norm(); };
        if (side(k) > side(longest)) longest = k;
      }
      const Vector& a = corners[longest];
      const Vector& b = corners[(longest + 1) % 3];
      const Vector& c = corners[(longest + 2) % 3];
      if ((b - a).norm() <= 1.0 || a.cwiseAbs().maxCoeff() > 12.0) {
        if (a.cwiseAbs().maxCoeff() <= 12.0) pieces.push_back(corners);
        continue;
      }
      left.push_back({a, 0.5 * (a + b), c});
      left.push_back({0.5 * (a + b), b, c});
    }
  }
  return pieces;
}

void ExpectAsByBruteForce(const test::Soup& soup,
                          const std::vector<ViewState>& views,
                          std::size_t every,
                          const QualityMap& map) {
  std::map<std::uint32_t, FaceQuality> quality_of_face;
  for (const auto& [id, block] : map.blocks()) {
    for (std::size_t i = 0; i < block.qualities.size(); ++i) {
      quality_of_face[block.mesh.KeyOf(i)[0].value / 3] = block.qualities[i];
    }
  }
  ASSERT_EQ(quality_of_face.size(), soup.size());
  int num_seen = 0;
  int num_hidden = 0;
  for (std::size_t face = 0; face < soup.size(); face += every) {
    const FaceQuality& quality = quality_of_face.at(static_cast<std::uint32_t>(face));
    const test::TrueQuality truth = test::BruteForce(soup, face, *map.camera(), views);
    ASSERT_EQ(quality.num_views, truth.num_views)
        << "face " << face << ", hidden " << quality.num_hidden << " against " << truth.num_hidden;
    ASSERT_EQ(quality.num_hidden, truth.num_hidden) << "face " << face;
    num_seen += truth.num_views;
    num_hidden += truth.num_hidden;
    if (truth.num_views == 0) continue;
    // The formula is exact; what is left are the finite differences of the rays.
    ASSERT_NEAR(quality.gsd / truth.gsd, 1.0, 0.005) << "face " << face;
  }
  EXPECT_GT(num_seen, 300);
  EXPECT_GT(num_hidden, 50);  // Else the test would not test hiding.
}

TEST(QualityMap, AgreesWithBruteForceOnAWallWithAPillar) {
  const test::Soup soup = WallWithPillar();
  const std::vector<ViewState> views = FlyPast(12);
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(MapOf(views), test::SnapshotOf(soup));
  ExpectAsByBruteForce(soup, views, 1, map);
}

TEST(QualityMap, AgreesWithBruteForceOnTheSimulatedFacade) {
  const test::Soup soup = TrueFacade();
  std::vector<ViewState> views = FlyPast(10);
  for (std::uint32_t i = 0; i < 4; ++i) {  // Oblique ones, that window reveals hide much from.
    views.push_back(test::MakeView(100 + i, test::LookAt({-2.0 + 3.0 * i, -3, 5}, {4, 0, 3})));
  }
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(MapOf(views), test::SnapshotOf(soup));
  ExpectAsByBruteForce(soup, views, 1 + soup.size() / 1500, map);
}

void ExpectEqual(const QualityMap& map, const QualityMap& fresh) {
  ASSERT_EQ(map.blocks().size(), fresh.blocks().size());
  for (const auto& [id, block] : fresh.blocks()) {
    ASSERT_EQ(map.blocks().count(id), 1U);
    EXPECT_EQ(map.blocks().at(id).qualities, block.qualities);
  }
  EXPECT_EQ(map.noise_px(), fresh.noise_px());
}

// The blocks of `after` that are others than in `before`, and those that are gone.
MeshDelta DeltaBetween(const MeshDelta& before, const MeshDelta& after) {
  std::map<BlockId, MeshBlock> old;
  for (const MeshBlock& block : before.blocks) old[block.id] = block;
  MeshDelta delta;
  for (const MeshBlock& block : after.blocks) {
    const auto found = old.find(block.id);
    if (found == old.end() || !(found->second == block)) delta.blocks.push_back(block);
    if (found != old.end()) old.erase(found);
  }
  for (auto& [id, block] : old) {
    MeshBlock gone;
    gone.id = id;
    delta.blocks.push_back(gone);
  }
  return delta;
}

// Law: whatever came and went, in whatever order and on however many threads, the outcome is that
// of the state reached.
TEST(QualityMap, IsAFunctionOfMapAndMeshAlone) {
  QualityOptions one_thread;
  one_thread.num_threads = 1;
  test::Random random(7);
  test::Soup soup = WallWithPillar();
  std::map<PhotoId, ViewState> views;
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  MeshDelta known;
  for (int step = 0; step < 12; ++step) {
    MapDelta map_delta;
    for (const ViewState& view : FlyPast(8)) {
      if (random.Uniform(0.0, 1.0) < 0.6) continue;
      ViewState moved = view;
      moved.cam_from_map.translation += random.InBox(0.2);
      views[moved.photo] = moved;
      map_delta.views_set.push_back(moved);
    }
    if (step % 4 == 3) {
      map_delta.views_removed = {views.begin()->first};
      views.erase(views.begin());
      map_delta.views_set.erase(map_delta.views_set.begin(), map_delta.views_set.end());
      for (const auto& [photo, view] : views) map_delta.views_set.push_back(view);
    }
    const auto first = static_cast<std::size_t>(random.Index(static_cast<int>(soup.size() - 40)));
    const Vector shift = random.InBox(0.5);
    for (std::size_t i = first; i < first + 40; ++i) {
      for (Vector& corner : soup[i]) corner += shift;
    }
    const MeshDelta snapshot = test::SnapshotOf(soup);
    map.Apply(map_delta, DeltaBetween(known, snapshot));
    known = snapshot;

    std::vector<ViewState> all_views;
    for (const auto& [photo, view] : views) all_views.push_back(view);
    QualityMap fresh{one_thread};
    fresh.Apply(MapOf(all_views), snapshot);
    fresh.SetCamera(test::SmallCamera());
    ExpectEqual(map, fresh);
    QualityMap again{QualityOptions()};
    again.SetCamera(test::SmallCamera());
    again.Apply(MapOf(FlyPast(3)), test::SnapshotOf(WallWithPillar()));
    again.Apply(MapOf(all_views), snapshot);
    ExpectEqual(again, fresh);
  }
}

TEST(QualityMap, SeesThatSomethingFarFromAFaceHidesIt) {
  test::Soup soup;
  test::AddGrid({0, 0, 0}, {4, 0, 0}, {0, 0, 4}, 8, 8, &soup);
  const MeshDelta bare = test::SnapshotOf(soup);
  test::AddGrid({1.5, -2.5, 1.5}, {1, 0, 0}, {0, 0, 1}, 2, 2, &soup);
  const MeshDelta covered = test::SnapshotOf(soup);
  const std::vector<ViewState> views = {
      test::MakeView(1, test::LookAt({2, -5, 2}, {2, 0, 2})),
      test::MakeView(2, test::LookAt({40, -5, 2}, {40, 0, 2}))};  // Elsewhere.
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(MapOf(views), bare);
  const std::vector<FaceQuality> before = map.blocks().at({2, 0, 2}).qualities;
  EXPECT_EQ(before[0].num_views, 1);

  const QualityUpdate update = map.Apply({}, DeltaBetween(bare, covered));
  EXPECT_THAT(update.blocks, testing::Contains(BlockId{2, 0, 2}));
  EXPECT_THAT(update.blocks, testing::Not(testing::Contains(BlockId{0, 0, 0})));
  EXPECT_EQ(map.blocks().at({2, 0, 2}).qualities[0].num_views, 0);
  EXPECT_EQ(map.blocks().at({2, 0, 2}).qualities[0].num_hidden, 1);

  map.Apply({}, DeltaBetween(covered, bare));
  EXPECT_EQ(map.blocks().at({2, 0, 2}).qualities, before);
}

TEST(QualityMap, LooksOnlyAtWhatChanged) {
  test::Soup soup;
  test::AddGrid({0, 0, 0}, {40, 0, 0}, {0, 0, 4}, 80, 8, &soup);
  const MeshDelta mesh = test::SnapshotOf(soup);
  std::vector<ViewState> views;
  for (std::uint32_t i = 0; i < 40; ++i) {
    views.push_back(test::MakeView(i, test::LookAt({i + 0.5, -3, 2}, {i + 0.5, 0, 2})));
  }
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  const QualityUpdate all = map.Apply(MapOf(views), mesh);
  EXPECT_EQ(all.blocks.size(), map.blocks().size());

  const QualityUpdate nothing = map.Apply({}, {});
  EXPECT_THAT(nothing.blocks, testing::IsEmpty());
  EXPECT_EQ(nothing.num_rays, 0U);

  const QualityUpdate same = map.Apply(MapOf(views), mesh);
  EXPECT_THAT(same.blocks, testing::IsEmpty());
  EXPECT_EQ(same.num_rays, 0U);

  // One view sees some 4 m of 40 m; one block is seen by some 5 views of 40.
  MapDelta moved;
  moved.views_set = {test::MakeView(20, test::LookAt({20.6, -3, 2}, {20.6, 0, 2}))};
  EXPECT_LT(map.Apply(moved, {}).num_rays, all.num_rays / 30);
  MeshDelta changed;
  changed.blocks = {mesh.blocks[80]};
  changed.blocks[0].vertices[0].position_in_map.y() += 0.01;
  const QualityUpdate update = map.Apply({}, changed);
  EXPECT_LT(update.num_rays, all.num_rays / 20);
  EXPECT_THAT(update.blocks, testing::Contains(changed.blocks[0].id));
  EXPECT_LT(update.blocks.size(), 10U);
}

TEST(QualityMap, AnObliqueViewIsCoarserByTheIncidence) {
  test::Soup soup;
  test::AddGrid({0, 0, 0}, {0.01, 0, 0}, {0, 0, 0.01}, 1, 1, &soup);
  const Camera camera("pinhole", 600, 400, DistortionModel::kPlumbBob, {500, 500, 300, 200});
  const Vector middle(0.005, 0, 0.005);
  for (const double incidence : {0.0, 0.5, 1.2}) {
    const Vector eye = middle + 5.0 * Vector(std::sin(incidence), -std::cos(incidence), 0.0);
    QualityMap map{QualityOptions()};
    map.SetCamera(camera);
    map.Apply(MapOf({test::MakeView(1, test::LookAt(eye, middle))}), test::SnapshotOf(soup));
    const double gsd = map.blocks().begin()->second.qualities[0].gsd;
    EXPECT_NEAR(gsd, 5.0 / 500.0 / std::cos(incidence), 0.01 * gsd);  // The face has a size.
  }
}

TEST(QualityMap, NobodySeesAnythingBeforeTheCameraIsKnown) {
  QualityMap map{QualityOptions()};
  map.Apply(MapOf(FlyPast(3)), test::SnapshotOf(WallWithPillar()));
  for (const auto& [id, block] : map.blocks()) {
    for (const FaceQuality& quality : block.qualities) EXPECT_EQ(quality, FaceQuality());
  }
}

TEST(QualityMap, ARefinedLensCountsAndAnImpossibleOneDoesNot) {
  const test::Soup soup = WallWithPillar();
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(MapOf(FlyPast(3)), test::SnapshotOf(soup));
  MapDelta delta;
  delta.lens = test::SmallCamera().lens();
  (*delta.lens)[kFx] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(map.Apply(delta, {}).blocks, testing::IsEmpty());
  (*delta.lens)[kFx] = (*delta.lens)[kFy] = 400.0;
  EXPECT_THAT(map.Apply(delta, {}).blocks, testing::Not(testing::IsEmpty()));
  EXPECT_EQ(map.camera()->lens()[kFx], 400.0);
  ExpectAsByBruteForce(soup, FlyPast(3), 1, map);
}

TEST(QualityMap, ARefinedLensCountsWheneverTheCameraBecomesKnown) {
  const Camera camera = test::SmallCamera();
  LensParameters<double> refined = camera.lens();
  refined[kFx] *= 1.1;
  MapDelta map_delta = MapOf(FlyPast(4));
  map_delta.lens = refined;
  const MeshDelta mesh = test::SnapshotOf(WallWithPillar());
  QualityMap expected{QualityOptions()};
  expected.SetCamera(*camera.WithLens(refined));
  expected.Apply(MapOf(FlyPast(4)), mesh);

  QualityMap before{QualityOptions()};
  before.Apply(map_delta, mesh);
  before.SetCamera(camera);
  ExpectEqual(before, expected);
  before.SetCamera(camera);  // A restarted mapper says it again.
  ExpectEqual(before, expected);

  QualityMap after{QualityOptions()};
  after.SetCamera(camera);
  after.Apply(map_delta, mesh);
  ExpectEqual(after, expected);
  MapDelta unrefined = MapOf(FlyPast(4));  // A snapshot of a map whose lens is the calibrated one.
  unrefined.is_snapshot = true;
  after.Apply(unrefined, mesh);
  EXPECT_EQ(after.camera()->lens(), camera.lens());
}

TEST(QualityMap, DegenerateFacesAndViewsDoNoHarm) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kHuge = 1e300;
  test::Soup soup = WallWithPillar();
  MeshDelta mesh = test::SnapshotOf(soup);
  MeshBlock odd;
  odd.id = {-100, 0, 0};
  test::AppendFace({Vector(1, 1, 1), Vector(1, 1, 1), Vector(1, 1, 1)}, 10000, &odd);
  test::AppendFace({Vector(0, 0, 0), Vector(1, 1, 1), Vector(2, 2, 2)}, 10003, &odd);
  test::AppendFace({Vector(kNan, 0, 0), Vector(1, kNan, 1), Vector(2, 2, 2)}, 10006, &odd);
  test::AppendFace({Vector(kHuge, 0, 0), Vector(0, kHuge, 0), Vector(0, 0, kHuge)}, 10009, &odd);
  mesh.blocks.insert(mesh.blocks.begin(), odd);
  std::vector<ViewState> views = FlyPast(12);
  views.push_back(test::MakeView(50, {Eigen::Quaterniond::Identity(), Vector(kNan, 0, 0)}));
  views.push_back(test::MakeView(51, {Eigen::Quaterniond::Identity(), Vector(kHuge, 0, kHuge)}));
  const Vector on_face = (soup[0][0] + soup[0][1] + soup[0][2]) / 3.0;
  const ViewState inside = test::MakeView(52, test::LookAt(on_face, on_face + Vector(0, 1, 0)));
  views.push_back(inside);
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(MapOf(views), mesh);
  for (const FaceQuality& quality : map.blocks().at(odd.id).qualities) {
    EXPECT_EQ(quality.num_views, 0);
  }
  MapDelta gone;
  gone.views_removed = {PhotoId{50}, PhotoId{51}, PhotoId{52}, PhotoId{777}};
  MeshDelta without;
  without.blocks.resize(1);
  without.blocks[0].id = odd.id;
  map.Apply(gone, without);
  ExpectAsByBruteForce(soup, FlyPast(12), 3, map);
}

}  // namespace
}  // namespace plumb
