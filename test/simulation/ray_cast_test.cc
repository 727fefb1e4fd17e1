// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plumbline/simulation/renderer.h"
#include "test/simulation/test_world.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using Eigen::Vector3d;
using test::Random;
using test::WorldBuilder;

// A wall y = 0, 20 m x 10 m, with a box on it and a plate.
World MakeWall() {
  WorldBuilder builder;
  const std::uint32_t material = builder.AddMaterial({});
  builder.AddRectangle(material, {0, 0, 0}, {20, 0, 0}, {0, 0, 10});
  builder.AddBox(material, {4, -1, 3}, {6, 0, 4});
  builder.AddPlate(
      {Eigen::Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitX())), {10, -0.002, 5}},
      0.5,
      "");
  return builder.world();
}

TEST(Cast, MeetsTheFirstSurface) {
  const Renderer renderer(MakeWall());
  const auto wall = renderer.Cast({2, -7, 2}, {0, 2, 0});
  ASSERT_TRUE(wall.has_value());
  EXPECT_NEAR((wall->point_in_world - Vector3d(2, 0, 2)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((wall->normal_in_world + Vector3d::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(wall->distance_m, 7.0);
  EXPECT_LT(wall->triangle, 2);
  EXPECT_EQ(wall->plate, -1);
  const auto box = renderer.Cast({5, -7, 3.5}, {0, 1, 0});
  ASSERT_TRUE(box.has_value());
  EXPECT_DOUBLE_EQ(box->distance_m, 6.0);
  const auto plate = renderer.Cast({10, -7, 5}, {0, 1, 0});
  ASSERT_TRUE(plate.has_value());
  EXPECT_EQ(plate->plate, 0);
  EXPECT_EQ(plate->triangle, -1);
  EXPECT_NEAR(plate->distance_m, 6.998, 1e-12);
  EXPECT_FALSE(renderer.Cast({2, -7, 2}, {0, -1, 0}).has_value());
}

TEST(Cast, IsExactFromFarAway) {
  const Renderer renderer(MakeWall());
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d target(random.Uniform(7, 9), 0.0, random.Uniform(1, 9));
    const Vector3d origin = target + 1e5 * Vector3d(random.Uniform(-0.5, 0.5), -1.0, 0.3);
    const auto hit = renderer.Cast(origin, target - origin);
    ASSERT_TRUE(hit.has_value());
    EXPECT_LT((hit->point_in_world - target).norm(), 1e-9);
  }
}

TEST(IsVisible, SeesAPointOnAWallAtAnyGrazingAngle) {
  const Renderer renderer(MakeWall());
  for (const double grazing_rad : {1.0, 0.1, 0.01, 1e-3, 2e-4}) {
    for (double x = 12.0; x < 19.0; x += 0.37) {
      const Vector3d point(x, 0.0, 1.234);
      const Vector3d eye =
          point + 6.0 * Vector3d(-std::cos(grazing_rad), -std::sin(grazing_rad), 0);
      EXPECT_TRUE(renderer.IsVisible(eye, point)) << grazing_rad << ' ' << x;
      EXPECT_TRUE(renderer.IsVisible(point, eye)) << grazing_rad << ' ' << x;
    }
  }
}

TEST(IsVisible, IsHiddenByWhatLiesBetween) {
  const Renderer renderer(MakeWall());
  EXPECT_FALSE(renderer.IsVisible({5, -7, 3.5}, {5, 0, 3.5}));    // The box.
  EXPECT_FALSE(renderer.IsVisible({2, -7, 2}, {2, 3, 2}));        // The wall.
  EXPECT_FALSE(renderer.IsVisible({2, -1e-3, 2}, {2, 1e-3, 2}));  // Closely.
  EXPECT_TRUE(renderer.IsVisible({3, -7, 2}, {2, -1, 2}));
  EXPECT_TRUE(renderer.IsVisible({2, -1, 2}, {2, -1, 2}));
}

TEST(IsVisible, AgreesWithCast) {
  const Renderer renderer(MakeWall());
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Vector3d eye(random.Uniform(0, 20), random.Uniform(-9, -2), random.Uniform(0, 10));
    const Vector3d point(random.Uniform(3, 7), random.Uniform(-1.5, -1e-3), random.Uniform(2, 5));
    const auto hit = renderer.Cast(eye, point - eye);
    const bool is_free = !hit || hit->distance_m >= (point - eye).norm() - 1e-4;
    EXPECT_EQ(renderer.IsVisible(eye, point), is_free) << point.transpose();
  }
}

}  // namespace
}  // namespace plumb
