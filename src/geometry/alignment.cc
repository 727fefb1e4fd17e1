// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/alignment.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

Eigen::Vector3d MeanOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// One point a column, relative to their mean.
Eigen::Matrix3Xd Centered(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& mean) {
  Eigen::Matrix3Xd centered(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    centered.col(static_cast<Eigen::Index>(i)) = points[i] - mean;
  }
  return centered;
}

bool IsOnLine(const Eigen::Matrix3Xd& centered) {
  constexpr double kMinRelativeWidth = 1e-6;
  const Eigen::Vector3d extent = Eigen::JacobiSVD<Eigen::MatrixXd>(centered).singularValues();
  return !(extent[1] > kMinRelativeWidth * extent[0]);
}

}  // namespace

std::optional<Similarity3> AlignPoints(const std::vector<Eigen::Vector3d>& points_in_source,
                                       const std::vector<Eigen::Vector3d>& points_in_target) {
  PLUMB_CHECK_EQ(points_in_source.size(), points_in_target.size());
  if (points_in_source.size() < 3) return std::nullopt;
  const Eigen::Vector3d source_mean = MeanOf(points_in_source);
  const Eigen::Vector3d target_mean = MeanOf(points_in_target);
  const Eigen::Matrix3Xd source = Centered(points_in_source, source_mean);
  const Eigen::Matrix3Xd target = Centered(points_in_target, target_mean);
  if (!source.allFinite() || !target.allFinite()) return std::nullopt;
  if (IsOnLine(source) || IsOnLine(target)) return std::nullopt;

  const Eigen::Matrix4d matrix = Eigen::umeyama(source, target, /*with_scaling=*/true);
  Similarity3 result;
  result.scale = matrix.col(0).head<3>().norm();
  if (!(result.scale > 0.0)) return std::nullopt;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>() / result.scale;
  result.rotation = Eigen::Quaterniond(rotation).normalized();
  result.translation = target_mean - result.scale * (result.rotation * source_mean);
  return result;
}

std::vector<double> AlignmentResiduals(const Similarity3& target_from_source,
                                       const std::vector<Eigen::Vector3d>& points_in_source,
                                       const std::vector<Eigen::Vector3d>& points_in_target) {
  PLUMB_CHECK_EQ(points_in_source.size(), points_in_target.size());
  std::vector<double> residuals;
  residuals.reserve(points_in_source.size());
  for (std::size_t i = 0; i < points_in_source.size(); ++i) {
    residuals.push_back((target_from_source * points_in_source[i] - points_in_target[i]).norm());
  }
  return residuals;
}

}  // namespace plumb
