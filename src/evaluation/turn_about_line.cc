// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/turn_about_line.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

struct Line {
  Eigen::Vector3d middle;
  Eigen::Vector3d direction;
  double max_offset = 0.0;
};

Line FitLine(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Map<const Eigen::Matrix3Xd> all(
      points.front().data(), 3, static_cast<Eigen::Index>(points.size()));
  Line line;
  line.middle = all.rowwise().mean();
  const Eigen::Matrix3Xd centered = all.colwise() - line.middle;
  line.direction = centered.jacobiSvd(Eigen::ComputeFullU).matrixU().col(0);
  const Eigen::Matrix3Xd offsets =
      centered - line.direction * (line.direction.transpose() * centered);
  line.max_offset = offsets.colwise().norm().maxCoeff();
  return line;
}

// The part of the rotation about the axis (its twist).
double TwistAbout(const Eigen::Vector3d& axis, const Eigen::Quaterniond& rotation) {
  return 2.0 * std::atan2(rotation.vec().dot(axis), rotation.w());
}

// The median of what is left beside the mean direction: angles have no order of their own.
double MedianAngle(const std::vector<double>& angles_rad) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const double angle : angles_rad) sum += Eigen::Vector2d(std::cos(angle), std::sin(angle));
  const double mean = std::atan2(sum.y(), sum.x());
  std::vector<double> rest;
  for (const double angle : angles_rad) rest.push_back(std::remainder(angle - mean, 2.0 * M_PI));
  const auto middle = rest.begin() + static_cast<std::ptrdiff_t>(rest.size() / 2);
  std::nth_element(rest.begin(), middle, rest.end());
  return mean + *middle;
}

}  // namespace

Similarity3 TurnAboutLine(const Similarity3& world_from_map,
                          const std::vector<Eigen::Vector3d>& centers_in_world,
                          const std::vector<CameraTurn>& turns,
                          double max_offset_m) {
  const Line line = FitLine(centers_in_world);
  if (line.max_offset > max_offset_m) return world_from_map;
  std::vector<double> twists_rad;
  for (const CameraTurn& turn : turns) {
    twists_rad.push_back(TwistAbout(
        line.direction,
        turn.cam_from_world.conjugate() * turn.cam_from_map * world_from_map.rotation.conjugate()));
  }
  const Eigen::Quaterniond twist(Eigen::AngleAxisd(MedianAngle(twists_rad), line.direction));
  return {world_from_map.scale,
          twist * world_from_map.rotation,
          line.middle + twist * (world_from_map.translation - line.middle)};
}

}  // namespace plumb
