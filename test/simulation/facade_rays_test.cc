// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What rays from outside meet: the surface is closed, faces outwards, and shows its plates.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "plumbline/simulation/renderer.h"
#include "test/simulation/small_facade.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using Eigen::Vector3d;

// A place outside the building, from which it can be photographed.
Vector3d RandomOutside(test::Random& random, const FacadeOptions& options) {
  while (true) {
    const Vector3d place(random.Uniform(-20.0, options.width_m + 20.0),
                         random.Uniform(-20.0, options.depth_m + 20.0),
                         random.Uniform(0.3, options.height_m + 10.0));
    const bool is_clear = place.x() < -2.0 || place.x() > options.width_m + 2.0 ||
                          place.y() < -2.0 || place.y() > options.depth_m + 2.0;
    if (is_clear) return place;
  }
}

void ExpectClosed(const FacadeOptions& options, int seed) {
  const Renderer renderer(BuildFacade(options));
  test::Random random(seed);
  int num_hits = 0;
  std::vector<Vector3d> backs;
  for (int k = 0; k < 200000; ++k) {
    const Vector3d origin = RandomOutside(random, options);
    const Vector3d aim(random.Uniform(-1.0, options.width_m + 1.0),
                       random.Uniform(-1.0, options.depth_m + 1.0),
                       random.Uniform(0.0, options.height_m + 2.0));
    const auto hit = renderer.Cast(origin, aim - origin);
    if (!hit) continue;
    ++num_hits;
    if (hit->normal_in_world.dot(aim - origin) >= 0.0) backs.push_back(hit->point_in_world);
  }
  EXPECT_GT(num_hits, 100000);
  // About one ray in 500000 slips into the seam of two solids that touch.
  EXPECT_LE(backs.size(), 2U) << "the back of a surface is seen at " << backs[0].transpose();
}

TEST(FacadeRays, OutsideRaysMeetOnlyFrontsOfAFreeStandingFacade) {
  ExpectClosed(test::SmallFacade(), 1);
}

TEST(FacadeRays, OutsideRaysMeetOnlyFrontsOfAClosedBuilding) {
  FacadeOptions options = test::SmallFacade();
  options.closed = true;
  options.balcony_share = 0.4;
  options.seed = 3;
  ExpectClosed(options, 2);
}

TEST(FacadeRays, OutsideRaysMeetOnlyFrontsOfARepeatedPlainFacade) {
  FacadeOptions options = test::SmallFacade();
  options.repetition = 1.0;
  options.textureless_share = 0.34;
  options.seed = 5;
  ExpectClosed(options, 3);
}

TEST(FacadeRays, PlatesAreSeenWholeFromTheFlightsPlaces) {
  const FacadeOptions options;
  const World world = BuildFacade(options);
  const Renderer renderer(world);
  ASSERT_EQ(world.plates.size(), 17U);
  for (const Plate& plate : world.plates) {
    for (const Vector3d& from : {Vector3d(0.0, 0.0, -4.0),
                                 Vector3d(-5.0, 0.0, -10.0),
                                 Vector3d(5.0, -3.0, -10.0),
                                 Vector3d(0.0, 0.5, -6.0)}) {
      for (const double u : {-0.49, 0.0, 0.49}) {
        const Vector3d on_plate(u * plate.side_m, 0.49 * plate.side_m, 0.0);
        const Vector3d origin = plate.world_from_plate * from;
        const auto hit = renderer.Cast(origin, plate.world_from_plate * on_plate - origin);
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->plate, plate.id) << "from " << origin.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace plumb
