// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/ellipse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/random.h"

namespace plumb::test {
namespace {

Ellipse MakeEllipse() {
  Ellipse ellipse;
  ellipse.center_px = {3000.5, 1200.25};
  ellipse.semi_major_px = 22.0;
  ellipse.semi_minor_px = 9.0;
  ellipse.angle_rad = 2.1;
  return ellipse;
}

std::vector<Eigen::Vector2d> PointsOn(const Ellipse& ellipse, int count, double noise_px) {
  Random random(3);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * M_PI * i / count;
    points.push_back(ellipse.center_px +
                     ellipse.PixelFromCircle() *
                         Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)) +
                     random.Normal2(noise_px));
  }
  return points;
}

void ExpectNear(const Ellipse& a, const Ellipse& b, double tolerance_px) {
  EXPECT_LT((a.center_px - b.center_px).norm(), tolerance_px);
  EXPECT_NEAR(a.semi_major_px, b.semi_major_px, tolerance_px);
  EXPECT_NEAR(a.semi_minor_px, b.semi_minor_px, tolerance_px);
  EXPECT_NEAR(a.angle_rad, b.angle_rad, tolerance_px);  // Radians; fits the axes above.
}

TEST(FitEllipse, FindsTheEllipseOfExactPoints) {
  const std::optional<Ellipse> fitted = FitEllipse(PointsOn(MakeEllipse(), 24, 0.0));
  ASSERT_TRUE(fitted);
  ExpectNear(*fitted, MakeEllipse(), 1e-6);
}

TEST(FitEllipse, StaysNearUnderNoise) {
  const std::optional<Ellipse> fitted = FitEllipse(PointsOn(MakeEllipse(), 72, 0.05));
  ASSERT_TRUE(fitted);
  ExpectNear(*fitted, MakeEllipse(), 0.05);
}

TEST(FitEllipse, RefusesTooFewPointsALineAndASpot) {
  EXPECT_FALSE(FitEllipse(PointsOn(MakeEllipse(), 5, 0.0)));
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i < 10; ++i) line.emplace_back(i, 2.0 * i);
  EXPECT_FALSE(FitEllipse(line));
  EXPECT_FALSE(FitEllipse(std::vector<Eigen::Vector2d>(10, Eigen::Vector2d(5.0, 5.0))));
}

TEST(FitEllipse, FindsTheCircleOfAnArc) {
  std::vector<Eigen::Vector2d> arc;
  for (int i = 0; i < 20; ++i) {
    arc.emplace_back(500.0 + 8.0 * std::cos(0.1 * i), -40.0 + 8.0 * std::sin(0.1 * i));
  }
  const std::optional<Ellipse> fitted = FitEllipse(arc);
  ASSERT_TRUE(fitted);
  EXPECT_LT((fitted->center_px - Eigen::Vector2d(500.0, -40.0)).norm(), 1e-6);
  EXPECT_NEAR(fitted->semi_major_px, 8.0, 1e-6);
  EXPECT_NEAR(fitted->semi_minor_px, 8.0, 1e-6);
}

// Twice a fit to twice as large points, turned: law of the frame.
TEST(FitEllipse, MovesWithTheImage) {
  const std::vector<Eigen::Vector2d> points = PointsOn(MakeEllipse(), 24, 1.0);
  std::vector<Eigen::Vector2d> moved;
  for (const Eigen::Vector2d& point : points) moved.emplace_back(-2.0 * point.y(), 2.0 * point.x());
  Ellipse expected = *FitEllipse(points);
  expected.center_px = 2.0 * Eigen::Vector2d(-expected.center_px.y(), expected.center_px.x());
  expected.semi_major_px *= 2.0;
  expected.semi_minor_px *= 2.0;
  expected.angle_rad -= M_PI / 2.0;
  ExpectNear(*FitEllipse(moved), expected, 1e-8);
}

TEST(FitEllipse, IsNothingOrAnEllipseWhateverThePoints) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double flatness = std::pow(10.0, random.Uniform(-16.0, 0.0));
    const int grid = random.Index(4);  // So coarse that points fall together.
    std::vector<Eigen::Vector2d> points;
    for (int k = 6 + random.Index(20); k > 0; --k) {
      Eigen::Vector2d point(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0));
      if (grid > 0) point = (grid * point).array().round();
      points.emplace_back(3000.0 + point.x(), 2000.0 + point.x() + flatness * point.y());
    }
    const std::optional<Ellipse> fitted = FitEllipse(points);
    if (!fitted) continue;
    ASSERT_TRUE(fitted->center_px.allFinite() && std::isfinite(fitted->angle_rad));
    ASSERT_TRUE(std::isfinite(fitted->semi_major_px) && fitted->semi_minor_px > 0.0);
    ASSERT_LE(fitted->semi_minor_px, fitted->semi_major_px);
  }
}

TEST(EllipseOfAffine, ItsOwnAffineGivesItBack) {  // Law: round trip.
  ExpectNear(EllipseOfAffine(MakeEllipse().center_px, MakeEllipse().PixelFromCircle()),
             MakeEllipse(),
             1e-9);
}

}  // namespace
}  // namespace plumb::test
