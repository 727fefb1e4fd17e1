// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/similarity_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "plumbline/geometry/alignment.h"

namespace plumb {
namespace {

constexpr int kNumUnknowns = 7;

Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

Similarity3 Updated(const Similarity3& similarity,
                    const Eigen::Vector3d& center,
                    const Eigen::Matrix<double, kNumUnknowns, 1>& step) {
  const Eigen::Vector3d center_in_target = similarity * center + step.tail<3>();
  const Eigen::Vector3d turn = step.head<3>();
  Similarity3 updated;
  updated.scale = similarity.scale * std::exp(step[3]);
  updated.rotation =
      (Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * similarity.rotation).normalized();
  updated.translation = center_in_target - updated.scale * (updated.rotation * center);
  return updated;
}

double ChiSquare(const std::vector<PointPair>& pairs,
                 const std::vector<int>& idxs,
                 const Similarity3& target_from_source,
                 double bend_sigma) {
  double sum = 0.0;
  for (const int idx : idxs) {
    const PointPair& pair = pairs[static_cast<std::size_t>(idx)];
    const Eigen::Matrix3d covariance = ResidualCovariance(pair, target_from_source, bend_sigma);
    sum += 3.0 * std::pow(NormalizedError(pair, target_from_source, covariance), 2);
  }
  return sum;
}

}  // namespace

Eigen::Matrix3d ResidualCovariance(const PointPair& pair,
                                   const Similarity3& target_from_source,
                                   double bend_sigma) {
  // Points without uncertainty would have no weight but infinity.
  constexpr double kLeast = 1e-8;
  const Eigen::Matrix3d turn = target_from_source.rotation.toRotationMatrix();
  return target_from_source.scale * target_from_source.scale *
             (turn * pair.source_covariance * turn.transpose()) +
         pair.target_covariance + (bend_sigma * bend_sigma + kLeast) * Eigen::Matrix3d::Identity();
}

double NormalizedError(const PointPair& pair,
                       const Similarity3& target_from_source,
                       const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d residual = target_from_source * pair.in_source - pair.in_target;
  return std::sqrt(residual.dot(covariance.ldlt().solve(residual)) / 3.0);
}

Eigen::Matrix<double, 3, 7> SimilarityJacobian(const Similarity3& target_from_source,
                                               const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& point_in_source) {
  const Eigen::Vector3d arm =
      target_from_source.scale * (target_from_source.rotation * (point_in_source - center));
  Eigen::Matrix<double, 3, 7> jacobian;
  jacobian << -Cross(arm), arm, Eigen::Matrix3d::Identity();
  return jacobian;
}

std::optional<SimilarityFit> FitSimilarity(const std::vector<PointPair>& pairs,
                                           const std::vector<int>& idxs,
                                           double bend_sigma) {
  constexpr int kMaxIterations = 10;
  std::vector<Eigen::Vector3d> in_source;
  std::vector<Eigen::Vector3d> in_target;
  SimilarityFit fit;
  for (const int idx : idxs) {
    const PointPair& pair = pairs[static_cast<std::size_t>(idx)];
    in_source.push_back(pair.in_source);
    in_target.push_back(pair.in_target);
    fit.center += pair.in_source / static_cast<double>(idxs.size());
  }
  const std::optional<Similarity3> start = AlignPoints(in_source, in_target);
  if (!start) return std::nullopt;
  fit.target_from_source = *start;
  for (int i = 0; i < kMaxIterations; ++i) {
    Matrix7d hessian = Matrix7d::Zero();
    Eigen::Matrix<double, kNumUnknowns, 1> gradient =
        Eigen::Matrix<double, kNumUnknowns, 1>::Zero();
    for (const int idx : idxs) {
      const PointPair& pair = pairs[static_cast<std::size_t>(idx)];
      const Eigen::Matrix3d weight =
          ResidualCovariance(pair, fit.target_from_source, bend_sigma).inverse();
      const Eigen::Matrix<double, 3, 7> jacobian =
          SimilarityJacobian(fit.target_from_source, fit.center, pair.in_source);
      hessian += jacobian.transpose() * weight * jacobian;
      gradient += jacobian.transpose() * weight *
                  (fit.target_from_source * pair.in_source - pair.in_target);
    }
    const Eigen::LDLT<Matrix7d> factors(hessian);
    const Eigen::Matrix<double, kNumUnknowns, 1> step = -factors.solve(gradient);
    if (!step.allFinite()) return std::nullopt;
    fit.target_from_source = Updated(fit.target_from_source, fit.center, step);
    fit.covariance = factors.solve(Matrix7d::Identity());
    if (step.head<4>().norm() < 1e-12) break;
  }
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

double MeasureBend(const std::vector<PointPair>& pairs,
                   const std::vector<int>& idxs,
                   const Similarity3& target_from_source) {
  const double freedom = 3.0 * static_cast<double>(idxs.size()) - kNumUnknowns;
  if (idxs.size() < 4) return 0.0;
  if (ChiSquare(pairs, idxs, target_from_source, 0.0) <= freedom) return 0.0;
  double high = 0.0;
  for (const int idx : idxs) {
    const PointPair& pair = pairs[static_cast<std::size_t>(idx)];
    high += (target_from_source * pair.in_source - pair.in_target).norm();
  }
  double low = 0.0;
  for (int i = 0; i < 50; ++i) {  // To the last bit but a few.
    const double middle = 0.5 * (low + high);
    (ChiSquare(pairs, idxs, target_from_source, middle) > freedom ? low : high) = middle;
  }
  return high;
}

}  // namespace plumb
