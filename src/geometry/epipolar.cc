// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/epipolar.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "geometry/levenberg_marquardt.h"
#include "geometry/pose_refinement.h"
#include "plumbline/geometry/relative_pose.h"

namespace plumb {
namespace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

// Two unit vectors orthogonal to a unit vector and to each other, as columns.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& unit) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = unit.unitOrthogonal();
  basis.col(1) = unit.cross(basis.col(0));
  return basis;
}

using EssentialDerivatives = std::array<Eigen::Matrix3d, 5>;

// Derivatives of [t]x R by a turn of R from the left and by a move of t on the unit sphere.
EssentialDerivatives DifferentiateEssential(const Rigid3& cam2_from_cam1) {
  const Eigen::Matrix3d rotation = cam2_from_cam1.rotation.toRotationMatrix();
  const Eigen::Matrix3d cross = CrossMatrix(cam2_from_cam1.translation);
  const Eigen::Matrix<double, 3, 2> tangent = TangentBasis(cam2_from_cam1.translation);
  EssentialDerivatives derivatives;
  for (int i = 0; i < 3; ++i) {
    derivatives[i] = cross * CrossMatrix(Eigen::Vector3d::Unit(i)) * rotation;
  }
  for (int i = 0; i < 2; ++i) derivatives[3 + i] = CrossMatrix(tangent.col(i)) * rotation;
  return derivatives;
}

// With the algebraic error c = x2^T E x1 and the slope n = |(E x1, E^T x2) without third
// entries|, the signed Sampson error is c / n.
LinearizedCost<5> Linearize(const Rigid3& cam2_from_cam1,
                            const std::vector<NormalizedMatch>& matches,
                            double huber_width) {
  const Eigen::Matrix3d essential = EssentialFromPose(cam2_from_cam1);
  const EssentialDerivatives derivatives = DifferentiateEssential(cam2_from_cam1);
  LinearizedCost<5> result;
  for (const NormalizedMatch& match : matches) {
    const Eigen::Vector3d x1 = match.xy1.homogeneous();
    const Eigen::Vector3d x2 = match.xy2.homogeneous();
    const Eigen::Vector3d line2 = essential * x1;
    const Eigen::Vector3d line1 = essential.transpose() * x2;
    const double slope2 = line1.head<2>().squaredNorm() + line2.head<2>().squaredNorm();
    if (!(slope2 > 0.0)) continue;
    const double inverse_slope = 1.0 / std::sqrt(slope2);
    const double error = x2.dot(line2) * inverse_slope;
    Eigen::Matrix<double, 5, 1> jacobian;
    for (int k = 0; k < 5; ++k) {
      const Eigen::Vector3d line2_change = derivatives[k] * x1;
      const Eigen::Vector2d line1_change = derivatives[k].leftCols<2>().transpose() * x2;
      const double slope_change =
          (line2.head<2>().dot(line2_change.head<2>()) + line1.head<2>().dot(line1_change)) *
          inverse_slope;
      jacobian[k] = (x2.dot(line2_change) - error * slope_change) * inverse_slope;
    }
    const HuberCost huber = Huber(error * error, huber_width);
    result.hessian.noalias() += huber.weight * jacobian * jacobian.transpose();
    result.gradient.noalias() += huber.weight * error * jacobian;
    result.cost += huber.cost;
  }
  return result;
}

Rigid3 Move(const Rigid3& cam2_from_cam1, const Eigen::Matrix<double, 5, 1>& delta) {
  const Eigen::Vector3d& translation = cam2_from_cam1.translation;
  const Eigen::Vector3d moved = translation + TangentBasis(translation) * delta.tail<2>();
  return {RotationFromVector(delta.head<3>()) * cam2_from_cam1.rotation, moved.normalized()};
}

}  // namespace

Eigen::Matrix3d EssentialFromPose(const Rigid3& cam2_from_cam1) {
  return CrossMatrix(cam2_from_cam1.translation) * cam2_from_cam1.rotation.toRotationMatrix();
}

double SampsonError(const Eigen::Matrix3d& essential,
                    const Eigen::Vector2d& xy1,
                    const Eigen::Vector2d& xy2) {
  return std::sqrt(SquaredSampsonError(essential, xy1, xy2));
}

std::array<Rigid3, 4> PosesFromEssential(const Eigen::Matrix3d& essential) {
  // Hartley & Zisserman, Multiple View Geometry, 2nd ed., result 9.19.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() < 0.0) u.col(2) = -u.col(2);
  if (v.determinant() < 0.0) v.col(2) = -v.col(2);
  Eigen::Matrix3d w;
  w << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const Eigen::Quaterniond rotation1(Eigen::Matrix3d(u * w * v.transpose()));
  const Eigen::Quaterniond rotation2(Eigen::Matrix3d(u * w.transpose() * v.transpose()));
  const Eigen::Vector3d translation = u.col(2);
  return {Rigid3(rotation1, translation),
          Rigid3(rotation1, -translation),
          Rigid3(rotation2, translation),
          Rigid3(rotation2, -translation)};
}

Rigid3 MinimizeSampsonError(const Rigid3& initial,
                            const std::vector<NormalizedMatch>& matches,
                            double huber_width,
                            int max_iterations) {
  if (matches.size() < 5) return initial;
  return MinimizeSquares<5>(
      initial,
      max_iterations,
      [&](const Rigid3& pose) { return Linearize(pose, matches, huber_width); },
      Move);
}

RelativePoseSigmas SigmasOf(const Rigid3& cam2_from_cam1,
                            const std::vector<NormalizedMatch>& matches,
                            double error_sigma) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::Matrix<double, 5, 5> information =
      Linearize(cam2_from_cam1, matches, kInfinity).hessian;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>> solver(information);
  const auto& eigenvalues = solver.eigenvalues();
  constexpr double kRounding = 1e-14;
  if (!(eigenvalues[0] > kRounding * eigenvalues[4])) return {kInfinity, kInfinity};
  const Eigen::Matrix<double, 5, 5> covariance = solver.eigenvectors() *
                                                 eigenvalues.cwiseInverse().asDiagonal() *
                                                 solver.eigenvectors().transpose();
  const auto largest_sigma = [&](const auto& block) {
    const Eigen::MatrixXd symmetric = block;
    return error_sigma *
           std::sqrt(symmetric.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
  };
  return {largest_sigma(covariance.topLeftCorner<3, 3>()),
          largest_sigma(covariance.bottomRightCorner<2, 2>())};
}

}  // namespace plumb
