// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>

namespace plumb {

// weight (block[offset..offset + 2] - measured): a marker's position, or the centre in a pose block
// (sfm/reprojection_cost.h), against a measured one.
class MeasuredPositionCost : public ceres::CostFunction {
 public:
  MeasuredPositionCost(const Eigen::Vector3d& measured, double weight, int block_size, int offset)
      : measured_(measured), weight_(weight), block_size_(block_size), offset_(offset) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(block_size);
  }

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> position(blocks[0] + offset_);
    Eigen::Map<Eigen::Vector3d>{residual} = weight_ * (position - measured_);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>> by_block(
        jacobians[0], 3, block_size_);
    by_block.setZero();
    by_block.middleCols<3>(offset_).diagonal().setConstant(weight_);
    return true;
  }

 private:
  Eigen::Vector3d measured_;
  double weight_;
  int block_size_;
  int offset_;
};

}  // namespace plumb
