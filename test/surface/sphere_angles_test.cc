// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sphere_angles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(SphereCosines, OfARegularTetrahedronAreAThird) {
  // The centre is a third of the radius above each face.
  EXPECT_THAT(SphereCosines({{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}}), Each(33));
}

TEST(SphereCosines, TheCenterMayLieBeyondAFace) {
  // A low top over a triangle in the unit circle: the sphere's centre is at (r^2 - h^2) / 2h below
  // the base for r = 1 and h = 0.5, that is 0.75 below, its radius 1.25.
  const double s = std::sqrt(0.75);
  const auto cosines = SphereCosines({{{0, 0, 0.5}, {1, 0, 0}, {-0.5, s, 0}, {-0.5, -s, 0}}});
  EXPECT_EQ(cosines[0], -60);
  EXPECT_GT(cosines[1], 0);
  EXPECT_THAT(cosines, ElementsAre(-60, cosines[1], cosines[1], cosines[1]));
}

TEST(SphereCosines, DoNotDependOnScalePlaceOrSense) {
  const std::array<Eigen::Vector3d, 4> corners = {
      {{0, 0, 0}, {1, 0.2, 0}, {0.3, 2, 0.1}, {0.2, 0.3, 0.7}}};
  std::array<Eigen::Vector3d, 4> moved = corners;
  for (Eigen::Vector3d& corner : moved) corner = 1e-3 * corner + Eigen::Vector3d(5, -7, 11);
  EXPECT_EQ(SphereCosines(moved), SphereCosines(corners));
  std::array<Eigen::Vector3d, 4> mirrored = corners;
  for (Eigen::Vector3d& corner : mirrored) corner.z() = -corner.z();
  EXPECT_EQ(SphereCosines(mirrored), SphereCosines(corners));
}

TEST(SphereCosines, OfWhatIsFlatOrNoNumberAreZeroOrInRange) {
  EXPECT_THAT(SphereCosines({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}), Each(0));
  EXPECT_THAT(SphereCosines({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}), Each(0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(SphereCosines({{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), Each(0));
}

}  // namespace
}  // namespace plumb
