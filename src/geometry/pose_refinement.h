// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

// A Rigid3 with its rotation as a matrix, for use on thousands of points.
struct Rigid3Matrix {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Rigid3Matrix() = default;
  explicit Rigid3Matrix(const Rigid3& transform)
      : rotation(transform.rotation.toRotationMatrix()), translation(transform.translation) {}

  Rigid3 ToRigid3() const { return {Eigen::Quaterniond(rotation), translation}; }
};

struct PoseObservation {
  Eigen::Vector2d xy;
  Eigen::Vector3d point_in_map;
  double weight;
};

// Rotation by the vector `turn` [rad].
Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& turn);

// RefineAbsolutePose on observations that are all in front of the initial camera.
Rigid3 MinimizeReprojectionError(const Rigid3& initial,
                                 const std::vector<PoseObservation>& observations,
                                 double huber_width,
                                 int max_iterations);

}  // namespace plumb
