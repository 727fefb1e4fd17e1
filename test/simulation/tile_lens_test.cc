// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/tile_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "test/simulation/test_world.h"

namespace plumb::internal {
namespace {

constexpr int kSide = 62;

// Strong barrel distortion, nearly 120 degrees wide.
Camera MakeWideCamera() {
  return Camera("wide",
                1600,
                1200,
                DistortionModel::kRationalPolynomial,
                {560.0, 561.0, 803.0, 597.0, 0.9, 0.1, 2e-4, -1e-4, 0.004, 1.25, 0.3, 0.02});
}

// Largest error of all pixels of some tiles, corners included [px].
double MaxErrorPx(const Camera& camera, bool* is_interpolated) {
  double max_error = 0.0;
  *is_interpolated = true;
  for (int top = 0; top < camera.height_px(); top += 4 * kSide) {
    for (int left = 0; left < camera.width_px(); left += 4 * kSide) {
      const int width = std::min(kSide, camera.width_px() - left);
      const int height = std::min(kSide, camera.height_px() - top);
      const TileLens lens(camera, left, top, width, height);
      *is_interpolated &= lens.is_interpolated();
      std::array<PixelRay, kSide> rays;
      for (int row = top; row < top + height; ++row) {
        lens.Row(left, row, width, rays.data());
        for (int i = 0; i < width; ++i) {
          const auto pixel = camera.Project({rays[i].x, rays[i].y, 1.0});
          max_error = std::max(max_error, (*pixel - Eigen::Vector2d(left + i, row)).norm());
        }
      }
    }
  }
  return max_error;
}

TEST(TileLens, LooksWhereTheCameraUnprojects) {
  bool is_interpolated = false;
  EXPECT_LT(MaxErrorPx(test::MakePaperCamera(), &is_interpolated), 1e-3);
  EXPECT_TRUE(is_interpolated);
  EXPECT_LT(MaxErrorPx(MakeWideCamera(), &is_interpolated), 1e-3);
}

TEST(TileLens, DerivativesAreThoseOfTheRays) {
  const Camera camera = test::MakePaperCamera();
  const TileLens lens(camera, 4800, 3200, kSide, kSide);
  const auto exact = [&](double column, double row) { return *camera.Unproject({column, row}); };
  PixelRay ray;
  lens.Row(4810, 3215, 1, &ray);
  const Eigen::Vector2d by_column = 0.5 * (exact(4811, 3215) - exact(4809, 3215));
  const Eigen::Vector2d by_row = 0.5 * (exact(4810, 3216) - exact(4810, 3214));
  EXPECT_NEAR(ray.x_by_column, by_column.x(), 1e-8);
  EXPECT_NEAR(ray.y_by_column, by_column.y(), 1e-8);
  EXPECT_NEAR(ray.x_by_row, by_row.x(), 1e-8);
  EXPECT_NEAR(ray.y_by_row, by_row.y(), 1e-8);
}

}  // namespace
}  // namespace plumb::internal
