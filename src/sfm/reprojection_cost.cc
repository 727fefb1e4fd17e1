// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/reprojection_cost.h"

#include <cmath>

namespace plumb {
namespace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

using PixelByXy = Eigen::Matrix2d;

// Pixel of normalised coordinates, and its derivative by them.
Eigen::Vector2d DistortedPixel(const double* lens, const Eigen::Vector2d& xy, PixelByXy* by_xy) {
  using Jet = ceres::Jet<double, 2>;
  const Jet x(xy.x(), 0);
  const Jet y(xy.y(), 1);
  Jet distorted_x;
  Jet distorted_y;
  Distort(lens, x, y, &distorted_x, &distorted_y);
  by_xy->row(0) = lens[kFx] * distorted_x.v.transpose();
  by_xy->row(1) = lens[kFy] * distorted_y.v.transpose();
  return {lens[kFx] * distorted_x.a + lens[kCx], lens[kFy] * distorted_y.a + lens[kCy]};
}

using PixelByLens = Eigen::Matrix<double, 2, kNumLensParameters, Eigen::RowMajor>;

PixelByLens DerivativeByLens(const double* lens, const Eigen::Vector2d& xy) {
  using Jet = ceres::Jet<double, kNumLensParameters>;
  std::array<Jet, kNumLensParameters> lens_jets;
  for (int i = 0; i < kNumLensParameters; ++i) {
    lens_jets[static_cast<std::size_t>(i)] = Jet(lens[i], i);
  }
  const std::array<Jet, 3> ray = {Jet(xy.x()), Jet(xy.y()), Jet(1.0)};
  std::array<Jet, 2> pixel;
  ProjectToPixel(lens_jets.data(), ray.data(), pixel.data());
  PixelByLens derivative;
  derivative.row(0) = pixel[0].v.transpose();
  derivative.row(1) = pixel[1].v.transpose();
  return derivative;
}

}  // namespace

Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& angle_axis, Eigen::Matrix3d* left_jacobian) {
  const double angle = angle_axis.norm();
  const Eigen::Matrix3d cross = CrossMatrix(angle_axis);
  // Below 1e-4 rad the series is cut where its error is under 1e-9.
  const bool is_small = angle < 1e-4;
  const double sine = is_small ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double versine = is_small ? 0.5 : (1.0 - std::cos(angle)) / (angle * angle);
  if (left_jacobian != nullptr) {
    const double cubic = is_small ? 1.0 / 6.0 : (1.0 - sine) / (angle * angle);
    *left_jacobian = Eigen::Matrix3d::Identity() + versine * cross + cubic * cross * cross;
  }
  return Eigen::Matrix3d::Identity() + sine * cross + versine * cross * cross;
}

ReprojectionCost::ReprojectionCost(const Eigen::Vector2d& pixel,
                                   double weight,
                                   const Eigen::Matrix3d* reference,
                                   const LensParameters<double>* fixed_lens)
    : pixel_(pixel), weight_(weight), reference_(reference), fixed_lens_(fixed_lens) {
  set_num_residuals(2);
  mutable_parameter_block_sizes()->push_back(kPoseBlockSize);
  mutable_parameter_block_sizes()->push_back(3);
  if (fixed_lens == nullptr) mutable_parameter_block_sizes()->push_back(kNumLensParameters);
}

bool ReprojectionCost::Evaluate(double const* const* blocks,
                                double* residual,
                                double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> angle_axis(blocks[0]);
  const Eigen::Map<const Eigen::Vector3d> center(blocks[0] + 3);
  const Eigen::Map<const Eigen::Vector3d> point_in_map(blocks[1]);
  const double* lens = fixed_lens_ != nullptr ? fixed_lens_->data() : blocks[2];

  Eigen::Matrix3d left_jacobian;
  const Eigen::Matrix3d rotation =
      ExpSo3(angle_axis, jacobians != nullptr ? &left_jacobian : nullptr) * *reference_;
  const Eigen::Vector3d point_in_cam = rotation * (point_in_map - center);
  if (!(point_in_cam.z() > 1e-9)) return false;

  const Eigen::Vector2d xy = point_in_cam.head<2>() / point_in_cam.z();
  PixelByXy by_xy;
  Eigen::Map<Eigen::Vector2d>{residual} = weight_ * (DistortedPixel(lens, xy, &by_xy) - pixel_);
  if (jacobians == nullptr) return true;

  Eigen::Matrix<double, 2, 3> xy_by_point;
  xy_by_point << 1.0, 0.0, -xy.x(), 0.0, 1.0, -xy.y();
  xy_by_point /= point_in_cam.z();
  FillPoseAndPoint(weight_ * by_xy * xy_by_point, point_in_cam, rotation, left_jacobian, jacobians);
  if (fixed_lens_ == nullptr && jacobians[2] != nullptr) {
    Eigen::Map<PixelByLens>{jacobians[2]} = weight_ * DerivativeByLens(lens, xy);
  }
  return true;
}

void ReprojectionCost::FillPoseAndPoint(const Eigen::Matrix<double, 2, 3>& pixel_by_point_in_cam,
                                        const Eigen::Vector3d& point_in_cam,
                                        const Eigen::Matrix3d& rotation,
                                        const Eigen::Matrix3d& left_jacobian,
                                        double** jacobians) const {
  using PoseJacobian = Eigen::Matrix<double, 2, kPoseBlockSize, Eigen::RowMajor>;
  using PointJacobian = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
  const Eigen::Matrix<double, 2, 3> by_point_in_map = pixel_by_point_in_cam * rotation;
  if (jacobians[0] != nullptr) {
    Eigen::Map<PoseJacobian> by_pose(jacobians[0]);
    by_pose.leftCols<3>() = -pixel_by_point_in_cam * CrossMatrix(point_in_cam) * left_jacobian;
    by_pose.rightCols<3>() = -by_point_in_map;
  }
  if (jacobians[1] != nullptr) Eigen::Map<PointJacobian>{jacobians[1]} = by_point_in_map;
}

}  // namespace plumb
