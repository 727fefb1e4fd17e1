// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "plumbline/camera/projection.h"

namespace plumb {

// A camera in a bundle: a small rotation on top of a reference rotation, and the centre.
//   point_in_cam = Exp(block[0..2]) reference (point_in_map - block[3..5])
constexpr int kPoseBlockSize = 6;

// Rotation of an angle-axis vector and, if asked, the left Jacobian of SO(3): Exp(a + da) ~
// Exp(J da) Exp(a) (Barfoot, State Estimation for Robotics, 2017, eq. 7.77).
Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& angle_axis, Eigen::Matrix3d* left_jacobian);

// Weighted difference between the projection of a landmark and its observed raw pixel [px],
// with analytic derivatives. Blocks: pose (6), landmark (3) and, if the lens is refined, lens
// (kNumLensParameters). Points behind the camera make the evaluation fail.
class ReprojectionCost : public ceres::CostFunction {
 public:
  // `reference` (and `fixed_lens`, null if the lens is a block) must outlive the cost.
  ReprojectionCost(const Eigen::Vector2d& pixel,
                   double weight,
                   const Eigen::Matrix3d* reference,
                   const LensParameters<double>* fixed_lens);

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override;

 private:
  void FillPoseAndPoint(const Eigen::Matrix<double, 2, 3>& pixel_by_point_in_cam,
                        const Eigen::Vector3d& point_in_cam,
                        const Eigen::Matrix3d& rotation,
                        const Eigen::Matrix3d& left_jacobian,
                        double** jacobians) const;

  Eigen::Vector2d pixel_;
  double weight_;
  const Eigen::Matrix3d* reference_;
  const LensParameters<double>* fixed_lens_;
};

}  // namespace plumb
