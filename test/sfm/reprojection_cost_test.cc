// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/reprojection_cost.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "test/support/random.h"

namespace plumb {
namespace {

using test::Random;

const LensParameters<double> kLens = {
    2500.0, 2450.0, 1990.0, 1510.0, -0.12, 0.05, 0.002, -0.001, 0.01, 0.02, -0.01, 0.005};

// A camera with a turn on top of its reference, and a point some 8 m before it.
struct Case {
  std::array<double, kPoseBlockSize> pose;
  Eigen::Vector3d point_in_map;
  LensParameters<double> lens = kLens;
  Eigen::Matrix3d reference;
  Eigen::Vector2d pixel = {1200.0, 1700.0};
  double weight = 0.7;
};

Case MakeCase(double angle_rad, Random* random) {
  Case made;
  const Rigid3 cam_from_map = random->Pose();
  made.reference = cam_from_map.rotation.toRotationMatrix();
  const Eigen::Vector3d axis = random->InBox(1.0).normalized();
  const Eigen::Vector3d center = random->InBox(5.0);
  for (int i = 0; i < 3; ++i) {
    made.pose[static_cast<std::size_t>(i)] = angle_rad * axis[i];
    made.pose[static_cast<std::size_t>(3 + i)] = center[i];
  }
  const Eigen::Vector3d point_in_cam = random->InBox(3.0) + Eigen::Vector3d(0.0, 0.0, 8.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
  made.point_in_map = (turn * made.reference).transpose() * point_in_cam + center;
  return made;
}

std::vector<double*> BlocksOf(Case* made) {
  return {made->pose.data(), made->point_in_map.data(), made->lens.data()};
}

Eigen::Vector2d ResidualOf(const ReprojectionCost& cost, const std::vector<double*>& blocks) {
  Eigen::Vector2d residual;
  EXPECT_TRUE(cost.Evaluate(blocks.data(), residual.data(), nullptr));
  return residual;
}

// By central differences; each step is small against the curvature of the projection.
Eigen::Matrix2Xd NumericJacobian(const ReprojectionCost& cost,
                                 std::vector<double*> blocks,
                                 std::size_t block,
                                 int size) {
  Eigen::Matrix2Xd jacobian(2, size);
  for (int i = 0; i < size; ++i) {
    double& value = blocks[block][i];
    const double start = value;
    const double step = 1e-6 * std::max(1.0, std::abs(start));
    value = start + step;
    const Eigen::Vector2d above = ResidualOf(cost, blocks);
    value = start - step;
    const Eigen::Vector2d below = ResidualOf(cost, blocks);
    value = start;
    jacobian.col(i) = (above - below) / (2.0 * step);
  }
  return jacobian;
}

template <int kSize>
Eigen::Matrix2Xd FromRowMajor(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::Matrix<double, 2, kSize, Eigen::RowMajor>>(values.data());
}

void ExpectNear(const Eigen::Matrix2Xd& analytic, const Eigen::Matrix2Xd& numeric) {
  EXPECT_LT((analytic - numeric).norm(), 1e-6 * numeric.norm() + 1e-5) << "analytic:\n"
                                                                       << analytic << "\nnumeric:\n"
                                                                       << numeric;
}

// Zero, where the series of the exponential is used, next to where it ends, and large.
constexpr double kAngles[] = {0.0, 1e-6, 0.9e-4, 1.1e-4, 0.1, 2.0};

TEST(ReprojectionCost, HasTheJacobianOfNumericDifferentiation) {
  Random random(3);
  for (const double angle_rad : kAngles) {
    for (int trial = 0; trial < 5; ++trial) {
      Case made = MakeCase(angle_rad, &random);
      const ReprojectionCost cost(made.pixel, made.weight, &made.reference, nullptr);
      ASSERT_EQ(cost.parameter_block_sizes(),
                (std::vector<std::int32_t>{kPoseBlockSize, 3, kNumLensParameters}));
      const std::vector<double*> blocks = BlocksOf(&made);
      std::vector<double> by_pose(2 * kPoseBlockSize);
      std::vector<double> by_point(2 * 3);
      std::vector<double> by_lens(2 * kNumLensParameters);
      double* jacobians[] = {by_pose.data(), by_point.data(), by_lens.data()};
      Eigen::Vector2d residual;
      ASSERT_TRUE(cost.Evaluate(blocks.data(), residual.data(), jacobians));
      ExpectNear(FromRowMajor<kPoseBlockSize>(by_pose),
                 NumericJacobian(cost, blocks, 0, kPoseBlockSize));
      ExpectNear(FromRowMajor<3>(by_point), NumericJacobian(cost, blocks, 1, 3));
      ExpectNear(FromRowMajor<kNumLensParameters>(by_lens),
                 NumericJacobian(cost, blocks, 2, kNumLensParameters));
    }
  }
}

TEST(ReprojectionCost, WithAHeldLensHasTheSameDerivatives) {
  Random random(4);
  Case made = MakeCase(0.3, &random);
  const ReprojectionCost cost(made.pixel, made.weight, &made.reference, &kLens);
  ASSERT_EQ(cost.parameter_block_sizes(), (std::vector<std::int32_t>{kPoseBlockSize, 3}));
  const std::vector<double*> blocks = BlocksOf(&made);
  std::vector<double> by_point(2 * 3);
  double* jacobians[] = {nullptr, by_point.data()};  // A constant pose asks for none.
  Eigen::Vector2d residual;
  ASSERT_TRUE(cost.Evaluate(blocks.data(), residual.data(), jacobians));
  ExpectNear(FromRowMajor<3>(by_point), NumericJacobian(cost, blocks, 1, 3));
}

TEST(ReprojectionCost, IsTheWeightedDifferenceFromProjectToPixel) {
  Random random(5);
  Case made = MakeCase(0.3, &random);
  const Eigen::Map<Eigen::Vector3d> angle_axis(made.pose.data());
  const Eigen::Map<Eigen::Vector3d> center(made.pose.data() + 3);
  const Eigen::AngleAxisd turn(angle_axis.norm(), angle_axis.normalized());
  const Eigen::Vector3d point_in_cam =
      turn * (made.reference * (made.point_in_map - Eigen::Vector3d(center)));
  Eigen::Vector2d pixel;
  ProjectToPixel(kLens.data(), point_in_cam.data(), pixel.data());
  const ReprojectionCost cost(made.pixel, made.weight, &made.reference, nullptr);
  EXPECT_LT((ResidualOf(cost, BlocksOf(&made)) - made.weight * (pixel - made.pixel)).norm(), 1e-9);
}

TEST(ReprojectionCost, FailsBehindTheCamera) {
  Random random(6);
  Case made = MakeCase(0.3, &random);
  const Eigen::Map<Eigen::Vector3d> center(made.pose.data() + 3);
  made.point_in_map = 2.0 * center - made.point_in_map;
  const ReprojectionCost cost(made.pixel, made.weight, &made.reference, nullptr);
  Eigen::Vector2d residual;
  EXPECT_FALSE(cost.Evaluate(BlocksOf(&made).data(), residual.data(), nullptr));
}

TEST(ExpSo3, IsTheRotationOfTheAngleAxis) {
  Random random(7);
  for (const double angle_rad : kAngles) {
    const Eigen::Vector3d axis = random.InBox(1.0).normalized();
    const Eigen::Matrix3d rotation = ExpSo3(angle_rad * axis, nullptr);
    EXPECT_LT((rotation - Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix()).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace plumb
