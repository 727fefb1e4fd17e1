// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

// A rotation, a scale and a translation. Named target_from_source:
//   point_in_target = scale * rotation * point_in_source + translation.
struct Similarity3 {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_source) const {
    return scale * (rotation * point_in_source) + translation;
  }

  // source_from_target.
  Similarity3 Inverse() const {
    const Eigen::Quaterniond inverse = rotation.conjugate();
    return {1.0 / scale, inverse, -(inverse * translation) / scale};
  }
};

// The pose of a camera after its map was transformed: cam_from_target, whose
// camera frame has the target's unit of length.
inline Rigid3 TransformCamera(const Similarity3& target_from_source,
                              const Rigid3& cam_from_source) {
  const Eigen::Quaterniond rotation =
      cam_from_source.rotation * target_from_source.rotation.conjugate();
  const Eigen::Vector3d center_in_target =
      target_from_source * cam_from_source.TargetOriginInSource();
  return {rotation, -(rotation * center_in_target)};
}

}  // namespace plumb
