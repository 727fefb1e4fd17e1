// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens_accuracy.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb {
namespace {

constexpr int kCols = 12;
constexpr int kRows = 8;

// Rays that meet a grid of places of the image, corners included. Solved by fixed-point steps, for
// a lens within a calibration may fold where Camera would refuse it.
std::vector<Eigen::Vector2d> ImageRays(int width_px,
                                       int height_px,
                                       const LensParameters<double>& lens) {
  std::vector<Eigen::Vector2d> rays;
  for (int i = 0; i < kCols * kRows; ++i) {
    const int row = i / kCols;
    const double x_px = (i % kCols) * (width_px - 1.0) / (kCols - 1);
    const double y_px = row * (height_px - 1.0) / (kRows - 1);
    const Eigen::Vector2d wanted((x_px - lens[kCx]) / lens[kFx], (y_px - lens[kCy]) / lens[kFy]);
    Eigen::Vector2d xy = wanted;
    for (int step = 0; step < 100; ++step) {
      Eigen::Vector2d there;
      Distort(lens.data(), xy.x(), xy.y(), &there.x(), &there.y());
      if (!there.allFinite()) break;
      xy += 0.7 * (wanted - there);  // Shortened, so that it settles for strong barrels too.
    }
    if (xy.allFinite() && xy.norm() < 10.0) rays.push_back(xy);
  }
  return rays;
}

// Takes from `fields` (two rows a ray, a column a field of displacements) what a small change of
// the pinhole and a small turn explain.
Eigen::MatrixXd WithoutPinholeAndTurn(const std::vector<Eigen::Vector2d>& rays,
                                      const LensParameters<double>& lens,
                                      const Eigen::MatrixXd& fields) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(fields.rows(), 6);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    using Jet = ceres::Jet<double, 2>;
    const Jet x(rays[i].x(), 0);
    const Jet y(rays[i].y(), 1);
    Jet distorted_x;
    Jet distorted_y;
    Distort(lens.data(), x, y, &distorted_x, &distorted_y);
    Eigen::Matrix2d by_ray;
    by_ray << lens[kFx] * distorted_x.v.transpose(), lens[kFy] * distorted_y.v.transpose();
    const double u = rays[i].x();
    const double v = rays[i].y();
    Eigen::Matrix<double, 2, 3> ray_by_turn;  // About x, y and z.
    ray_by_turn << -u * v, 1.0 + u * u, -v, -1.0 - v * v, u * v, u;
    const auto row = static_cast<Eigen::Index>(2 * i);
    basis.block<2, 3>(row, 0) = by_ray * ray_by_turn;
    basis.block<2, 1>(row, 3) << distorted_x.a, distorted_y.a;
    basis(row, 4) = 1.0;
    basis(row + 1, 5) = 1.0;
  }
  return fields - basis * basis.completeOrthogonalDecomposition().solve(fields);
}

}  // namespace

double DistortionSigma(int width_px,
                       int height_px,
                       const LensParameters<double>& lens,
                       const Eigen::MatrixXd& covariance) {
  const std::vector<Eigen::Vector2d> rays = ImageRays(width_px, height_px, lens);
  if (rays.empty()) return 0.0;
  Eigen::MatrixXd by_lens(2 * static_cast<Eigen::Index>(rays.size()), kNumLensParameters);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    using Jet = ceres::Jet<double, kNumLensParameters>;
    LensParameters<Jet> jets;
    for (int k = 0; k < kNumLensParameters; ++k) {
      jets[static_cast<std::size_t>(k)] = Jet(lens[static_cast<std::size_t>(k)], k);
    }
    const Jet point[3] = {Jet(rays[i].x()), Jet(rays[i].y()), Jet(1.0)};
    Jet pixel[2];
    ProjectToPixel(jets.data(), point, pixel);
    const auto row = static_cast<Eigen::Index>(2 * i);
    by_lens.row(row) = pixel[0].v.transpose();
    by_lens.row(row + 1) = pixel[1].v.transpose();
  }
  const Eigen::MatrixXd left = WithoutPinholeAndTurn(rays, lens, by_lens);
  const Eigen::MatrixXd lens_covariance =
      covariance.topLeftCorner(kNumLensParameters, kNumLensParameters);
  const double sum = (left * lens_covariance * left.transpose()).trace();
  return std::sqrt(std::max(0.0, sum) / static_cast<double>(rays.size()));
}

double DistortionDifference(int width_px,
                            int height_px,
                            const LensParameters<double>& truth,
                            const LensParameters<double>& other) {
  const std::vector<Eigen::Vector2d> rays = ImageRays(width_px, height_px, truth);
  Eigen::MatrixXd field(2 * static_cast<Eigen::Index>(rays.size()), 1);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double point[3] = {rays[i].x(), rays[i].y(), 1.0};
    Eigen::Vector2d seen;
    Eigen::Vector2d there;
    ProjectToPixel(truth.data(), point, seen.data());
    ProjectToPixel(other.data(), point, there.data());
    field.block<2, 1>(static_cast<Eigen::Index>(2 * i), 0) = there - seen;
  }
  return WithoutPinholeAndTurn(rays, truth, field).norm() /
         std::sqrt(static_cast<double>(rays.size()));
}

}  // namespace plumb
