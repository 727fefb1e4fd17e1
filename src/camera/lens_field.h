// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "plumbline/camera/projection.h"

namespace plumb {

struct DistortedPoint {
  Eigen::Vector2d xy;
  Eigen::Matrix2d jacobian;  // By the undistorted point; symmetric.
};

// Distort() of projection.h with its Jacobian.
DistortedPoint DistortWithJacobian(const LensParameters<double>& lens, const Eigen::Vector2d& xy);

// Radius, in normalised coordinates, of the largest disc around the optical axis on
// which the distortion is one-to-one; at most kMaxFieldRadius.
//
// The distortion is the gradient of a scalar (its Jacobian is symmetric), so it is one-to-one
// on any convex set on which the Jacobian is positive definite.
double OneToOneRadius(const LensParameters<double>& lens);

// 89.4 degrees off the axis: no perspective lens sees farther.
constexpr double kMaxFieldRadius = 100.0;

}  // namespace plumb
