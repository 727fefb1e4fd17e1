// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/sphere_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

// Relative to the first corner, p, the centre c of the sphere solves 2 a.c = |a|^2 for each of the
// edges a from p.
Eigen::Vector3d CenterFromFirst(const std::array<Eigen::Vector3d, 4>& corners) {
  const Eigen::Vector3d a = corners[1] - corners[0];
  const Eigen::Vector3d b = corners[2] - corners[0];
  const Eigen::Vector3d c = corners[3] - corners[0];
  return (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) +
          c.squaredNorm() * a.cross(b)) /
         (2.0 * a.dot(b.cross(c)));
}

std::int8_t InUnits(double cosine) {
  if (!std::isfinite(cosine)) return 0;
  return static_cast<std::int8_t>(std::lround(kCosineUnit * std::clamp(cosine, -1.0, 1.0)));
}

}  // namespace

std::array<std::int8_t, 4> SphereCosines(const std::array<Eigen::Vector3d, 4>& corners) {
  const Eigen::Vector3d center_from_first = CenterFromFirst(corners);
  const double radius = center_from_first.norm();
  const Eigen::Vector3d center = corners[0] + center_from_first;
  std::array<std::int8_t, 4> cosines;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& on_face = corners[(i + 1) % 4];
    const Eigen::Vector3d normal =
        (corners[(i + 2) % 4] - on_face).cross(corners[(i + 3) % 4] - on_face).normalized();
    const double height = normal.dot(center - on_face);
    const bool is_inward = normal.dot(corners[i] - on_face) > 0.0;
    cosines[i] = InUnits((is_inward ? height : -height) / radius);
  }
  return cosines;
}

}  // namespace plumb
