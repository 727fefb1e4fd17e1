// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumb {

// A rotation followed by a translation. Named target_from_source: it maps
// points of the source frame into the target frame,
//   point_in_target = rotation * point_in_source + translation.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Rigid3() = default;
  Rigid3(const Eigen::Quaterniond& target_from_source_rotation,
         const Eigen::Vector3d& source_origin_in_target)
      : rotation(target_from_source_rotation.normalized()), translation(source_origin_in_target) {}

  // source_from_target.
  Rigid3 Inverse() const {
    const Eigen::Quaterniond inverse = rotation.conjugate();
    return {inverse, -(inverse * translation)};
  }

  // The target's origin in the source frame; for cam_from_map, the camera centre in the map.
  Eigen::Vector3d TargetOriginInSource() const { return -(rotation.conjugate() * translation); }

  // [R | t].
  Eigen::Matrix<double, 3, 4> Matrix() const {
    Eigen::Matrix<double, 3, 4> matrix;
    matrix << rotation.toRotationMatrix(), translation;
    return matrix;
  }

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_source) const {
    return rotation * point_in_source + translation;
  }
};

// c_from_a = c_from_b * b_from_a.
inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

}  // namespace plumb
