// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/evaluation/test_surfaces.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

TEST(PointsSeen, LeavesOutWhatIsHiddenOrOutsideThePhotos) {
  TriangleMesh mesh = test::MakeWall();
  test::AddRectangle({5, -2, 0}, {1, 0, 0}, {0, 0, 10}, false, &mesh);  // A pillar's front.
  const MeshIndex surface(mesh);
  const Camera camera = test::MakeCamera();  // 8 m wide at 5 m.
  const std::vector<TruePose> photos = {{"a", test::FacingFacade(), {5.5, -5, 5}},
                                        {"b", test::FacingFacade(), {3.0, -5, 5}}};
  const Eigen::Vector3d behind_pillar(5.5, 0, 5);
  const Eigen::Vector3d in_both(2.5, 0, 5);
  const Eigen::Vector3d in_a(8.0, 0, 5);
  const Eigen::Vector3d outside(19, 0, 5);
  const std::vector<Eigen::Vector3d> points = {behind_pillar, in_both, in_a, outside};
  EXPECT_THAT(PointsSeen(points, surface, camera, photos, 2), testing::ElementsAre(in_both));
  EXPECT_THAT(PointsSeen(points, surface, camera, photos, 1),
              testing::ElementsAre(behind_pillar, in_both, in_a));
}

TEST(PointsSeen, LeavesOutTheBackground) {
  const MeshIndex surface(test::MakeWall());
  const std::vector<TruePose> photos = {{"far", test::FacingFacade(), {10, -21, 5}}};
  EXPECT_THAT(PointsSeen({{10, 0, 5}}, surface, test::MakeCamera(), photos, 1), testing::IsEmpty());
}

double AreaOf(const TriangleMesh& mesh) {
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area_m2 += TriangleArea(mesh, i);
  return area_m2;
}

TEST(PiecesInView, HoldsAllThatIsSeenAndLittleMore) {  // Law: nothing seen is lost.
  TriangleMesh ground = test::MakeWall();
  test::AddRectangle({-5000, -9000, 0}, {10000, 0, 0}, {0, 9000, 0}, false, &ground);
  const MeshIndex surface(ground);
  const Camera camera = test::MakeCamera();  // 12 m^2 a metre^2 of distance: 8 m x 6 m at 5 m.
  const std::vector<TruePose> photos = {{"a", test::FacingFacade(), {6, -5, 4}}};
  const TriangleMesh pieces = PiecesInView(ground, camera, photos);
  EXPECT_GT(AreaOf(pieces), 48.0);
  EXPECT_LT(AreaOf(pieces), 200.0);  // Of 90 km^2.

  std::vector<Eigen::Vector3d> points;
  for (double x_m = 0.05; x_m < 20.0; x_m += 0.1) {
    for (double z_m = 0.05; z_m < 10.0; z_m += 0.1) points.emplace_back(x_m, 0.0, z_m);
  }
  const MeshIndex index_of_pieces(pieces);
  for (const auto& point : PointsSeen(points, surface, camera, photos, 1)) {
    ASSERT_LT(index_of_pieces.NearestTo(point).distance, 1e-9);
  }
}

TEST(PiecesInView, MayBeNone) {
  const std::vector<TruePose> photos = {
      {"away",
       Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY())) * test::FacingFacade(),
       {6, -5, 4}}};
  EXPECT_TRUE(PiecesInView(test::MakeWall(), test::MakeCamera(), photos).triangles.empty());
}

}  // namespace
}  // namespace plumb
