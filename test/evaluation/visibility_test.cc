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

}  // namespace
}  // namespace plumb
