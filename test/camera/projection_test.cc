// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/camera/projection.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <complex>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "camera/lens_field.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

const LensParameters<double> kPlumbBobLens = {
    2200.0, 2210.0, 1990.0, 1510.0, -0.28, 0.11, 1e-3, -8e-4, -0.02, 0.0, 0.0, 0.0};
const LensParameters<double> kRationalLens = {
    870.0, 872.0, 955.0, 610.0, 4.1, 2.3, 1e-3, -2e-3, 0.09, 4.5, 3.6, 0.55};

TEST(ProjectToPixel, AgreesWithOpenCv) {
  for (const LensParameters<double>& lens : {kPlumbBobLens, kRationalLens}) {
    test::Random random(3);
    std::vector<cv::Point3d> points;
    for (int i = 0; i < 500; ++i) {
      const double x = random.Uniform(-2.0, 2.0);
      const double y = random.Uniform(-2.0, 2.0);
      points.emplace_back(x, y, random.Uniform(3.0, 20.0));
    }
    const cv::Matx33d matrix(lens[kFx], 0, lens[kCx], 0, lens[kFy], lens[kCy], 0, 0, 1);
    const std::vector<double> distortion(lens.begin() + kK1, lens.end());
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix, distortion, expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d point(points[i].x, points[i].y, points[i].z);
      Eigen::Vector2d pixel;
      ProjectToPixel(lens.data(), point.data(), pixel.data());
      EXPECT_NEAR(pixel.x(), expected[i].x, 1e-9);
      EXPECT_NEAR(pixel.y(), expected[i].y, 1e-9);
    }
  }
}

TEST(Distort, DifferentiatesThroughItsTemplateType) {
  // The imaginary part after a step of i h is h times the derivative, without cancellation.
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  for (const LensParameters<double>& lens : {kPlumbBobLens, kRationalLens}) {
    LensParameters<Complex> complex_lens;
    for (int i = 0; i < kNumLensParameters; ++i) complex_lens[i] = lens[i];
    const Eigen::Vector2d xy(0.31, -0.42);
    const Eigen::Matrix2d jacobian = DistortWithJacobian(lens, xy).jacobian;
    for (int column = 0; column < 2; ++column) {
      const Complex x(xy.x(), column == 0 ? kStep : 0.0);
      const Complex y(xy.y(), column == 1 ? kStep : 0.0);
      Complex distorted_x;
      Complex distorted_y;
      Distort(complex_lens.data(), x, y, &distorted_x, &distorted_y);
      EXPECT_NEAR(jacobian(0, column), distorted_x.imag() / kStep, 1e-14);
      EXPECT_NEAR(jacobian(1, column), distorted_y.imag() / kStep, 1e-14);
    }
  }
}

TEST(ProjectToPixel, HasTheDerivativesThatFiniteDifferencesGive) {
  constexpr double kStep = 1e-6;
  const Eigen::Vector3d point(1.3, -0.7, 4.0);
  for (const LensParameters<double>& lens : {kPlumbBobLens, kRationalLens}) {
    const Eigen::Vector2d xy = point.hnormalized();
    const Eigen::Matrix2d by_xy = DistortWithJacobian(lens, xy).jacobian;
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Vector3d ahead = point;
      Eigen::Vector3d behind = point;
      ahead[axis] += kStep * point.z();
      behind[axis] -= kStep * point.z();
      Eigen::Vector2d pixel_ahead;
      Eigen::Vector2d pixel_behind;
      ProjectToPixel(lens.data(), ahead.data(), pixel_ahead.data());
      ProjectToPixel(lens.data(), behind.data(), pixel_behind.data());
      const Eigen::Vector2d numeric = (pixel_ahead - pixel_behind) / (2.0 * kStep);
      EXPECT_NEAR(numeric.x(), lens[kFx] * by_xy(0, axis), 1e-4);
      EXPECT_NEAR(numeric.y(), lens[kFy] * by_xy(1, axis), 1e-4);
    }
  }
}

TEST(OneToOneRadius, IsWhereADenselySampledJacobianFirstTurnsSingular) {  // Brute force.
  LensParameters<double> lens = kPlumbBobLens;
  lens[kP1] = 0.02;
  lens[kP2] = -0.03;
  const double radius = OneToOneRadius(lens);
  ASSERT_LT(radius, kMaxFieldRadius);
  double least_inside = 1.0;
  double least_outside = 1.0;
  for (int i = 0; i < 3600; ++i) {
    const double angle = i * M_PI / 1800.0;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const auto determinant = [&](double r) {
      return DistortWithJacobian(lens, r * direction).jacobian.determinant();
    };
    for (const double part : {0.25, 0.5, 0.75, 0.9, 0.999}) {
      least_inside = std::min(least_inside, determinant(part * radius));
    }
    least_outside = std::min(least_outside, determinant(1.001 * radius));
  }
  EXPECT_GT(least_inside, 0.0);
  EXPECT_LT(least_outside, 0.0);
}

}  // namespace
}  // namespace plumb
