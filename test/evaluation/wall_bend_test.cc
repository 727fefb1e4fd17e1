// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/wall_bend.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "test/evaluation/test_surfaces.h"
#include "test/support/random.h"

namespace plumb {
namespace {

// 20 m x 10 m, `num_points` at random places.
std::vector<WallPoint> MakePoints(int num_points,
                                  double noise_m,
                                  const std::function<double(double, double)>& height_m) {
  test::Random random(1);
  std::vector<WallPoint> points;
  for (int i = 0; i < num_points; ++i) {
    const double u_m = random.Uniform(0.0, 20.0);
    const double v_m = random.Uniform(0.0, 10.0);
    points.emplace_back(u_m, v_m, height_m(u_m, v_m) + random.Normal(noise_m));
  }
  return points;
}

TEST(MeasureBend, FindsAKnownParabola) {
  // 30 mm deep over 20 m: h = 30 ((u - 10) / 10)^2. Ten columns of cells, centred at |u - 10| = 1,
  // 3, 5, 7, 9 m, have medians of about 30 (0.01, 0.09, 0.25, 0.49, 0.81); their mean, the best
  // plane, is 9.9, so the outermost are off by 24.3 - 9.9 = 14.4 mm.
  const auto wall = MeasureBend({}, MakePoints(100'000, 0.0, [](double u_m, double) {
                                  return 0.030 * std::pow((u_m - 10.0) / 10.0, 2);
                                }));
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->cells.size(), 50u);
  EXPECT_NEAR(wall->max_mm, 14.4, 0.4);  // The cells' places and sampling.
  EXPECT_NEAR(wall->range_mm, 24.0, 0.6);
  EXPECT_NEAR(wall->rms_mm, 8.7, 0.3);  // Of (0.01, 0.09, 0.25, 0.49, 0.81) about their mean.
}

TEST(MeasureBend, DoesNotCallTiltAndOffsetABend) {
  const auto wall = MeasureBend({}, MakePoints(20'000, 0.0, [](double u_m, double v_m) {
                                  return 0.05 + 0.0001 * u_m - 0.0002 * v_m;
                                }));
  ASSERT_TRUE(wall);
  EXPECT_LT(wall->max_mm, 0.02);  // A cell's median height is not quite that of its centroid.
}

TEST(MeasureBend, DoesNotCallNoiseABend) {
  const auto wall = MeasureBend({}, MakePoints(20'000, 0.006, [](double, double) { return 0.0; }));
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->cells.size(), 50u);
  EXPECT_LT(wall->max_mm, 1.3);  // 6 mm * 1.25 / sqrt(400) = 0.4 mm; the largest of 50.
  EXPECT_NEAR(wall->sigma_mm, 0.38, 0.1);
}

TEST(MeasureBend, TheStatedSigmaIsThatOfTheCells) {
  const auto wall = MeasureBend({}, MakePoints(40'000, 0.006, [](double, double) { return 0.0; }));
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->rms_mm, 0.006 * 1e3 * 1.2533 / std::sqrt(800.0), 0.06);
}

TEST(MeasureBend, WithstandsAFifthOfWrongPoints) {
  std::vector<WallPoint> points =
      MakePoints(50'000, 0.002, [](double u_m, double) { return u_m > 10.0 ? 0.010 : 0.0; });
  for (std::size_t i = 0; i < points.size(); i += 5) points[i].z() = i % 2 == 0 ? -0.25 : 0.25;
  const auto wall = MeasureBend({}, points);
  ASSERT_TRUE(wall);
  // A step of 10 mm; the best line has the slope 1.5 * 10 mm / 20 m, and is off most, by
  // half a step less 1 m of slope, beside the step.
  EXPECT_NEAR(wall->max_mm, 5.0 - 0.75, 0.5);
}

TEST(MeasureBend, LeavesOutCellsThatSayNothing) {
  std::vector<WallPoint> points = MakePoints(20'000, 0.002, [](double, double) { return 0.0; });
  for (int i = 0; i < 15; ++i) points.emplace_back(31.0 + 0.05 * i, 1.0, 0.2);  // Too few.
  test::Random random(2);
  for (int i = 0; i < 100; ++i) points.emplace_back(41.0, 1.0, random.Normal(0.05));  // Too wild.
  const auto wall = MeasureBend({}, points);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->cells.size(), 50u);
  EXPECT_EQ(wall->num_left_out, 2);
  EXPECT_LT(wall->max_mm, 0.6);
}

TEST(MeasureBend, GivesNothingWhereNoPlaneIsDetermined) {
  EXPECT_FALSE(MeasureBend({}, {}));
  EXPECT_FALSE(MeasureBend({}, std::vector<WallPoint>(500, {1.0, 1.0, 0.0})));
  std::vector<WallPoint> row;
  for (int i = 0; i < 1000; ++i) row.emplace_back(0.02 * i, 1.0, 0.0);
  EXPECT_FALSE(MeasureBend({}, row));
}

TEST(MeasureBend, NamesABadOption) {
  WallBendOptions options;
  options.cell_m = 0.0;
  EXPECT_THROW(MeasureBend(options, {}), std::invalid_argument);
}

TEST(PointsOfMainWall, TakesThoseNearestToTheWallInItsFrame) {
  const TriangleMesh truth = test::MakeWall();
  const MeshIndex index(truth);
  const std::vector<WallPoint> points = PointsOfMainWall(
      {}, truth, index, {{4, -0.02, 5}, {14, 0.01, 6}, {4, -0.5, 0.1}, {4, -0.4, 5}, {4, 9, 5}});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].z(), 0.02, 1e-12);  // Before the wall, which faces -y.
  EXPECT_NEAR(points[1].z(), -0.01, 1e-12);
  EXPECT_NEAR(points[1].x() - points[0].x(), 10.0, 1e-12);
  EXPECT_NEAR(points[1].y() - points[0].y(), 1.0, 1e-12);
}

TEST(PointsOfMainWall, RefusesASurfaceThatMarksNoWallOrAnUnevenOne) {
  TriangleMesh truth = test::MakeWall();
  const MeshIndex index(truth);
  truth.is_main_wall.assign(4, 1);
  EXPECT_THROW(PointsOfMainWall({}, truth, index, {}), std::invalid_argument);
  truth.is_main_wall.clear();
  EXPECT_THROW(PointsOfMainWall({}, truth, index, {}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
