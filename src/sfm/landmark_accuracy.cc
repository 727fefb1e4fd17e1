// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/landmark_accuracy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plumbline/sfm/bundle_problem.h"
#include "sfm/reprojection_cost.h"

namespace plumb {
namespace {

// Standard deviation over median absolute deviation, of a normal distribution.
constexpr double kSigmaPerMad = 1.4826;

// Weight of the common scatter against a landmark's own [degrees of freedom].
constexpr double kPriorFreedom = 4.0;

// Of a feature's scale on the facade: over the 10 m row of a simulated flight, with the true lens,
// 68 % of the points lie within two standard deviations by the rays alone, 80, 87 and 90 % with
// 0.1, 0.2 and 0.3 of it.
constexpr double kReliefPerFootprint = 0.3;

struct Sums {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  int num_observations = 0;
};

struct Residuals {
  std::vector<Sums> of_landmark;
  std::vector<double> absolute;  // Of all coordinates.
};

Residuals Evaluate(const BundleProblem& problem) {
  std::vector<Eigen::Matrix3d> rotations;
  std::vector<std::array<double, kPoseBlockSize>> poses;
  for (const BundleView& view : problem.views) {
    rotations.push_back(view.cam_from_map.rotation.toRotationMatrix());
    const Eigen::Vector3d center = view.cam_from_map.TargetOriginInSource();
    poses.push_back({0.0, 0.0, 0.0, center.x(), center.y(), center.z()});
  }
  Residuals residuals;
  residuals.of_landmark.resize(problem.landmarks.size());
  for (const BundleObservation& observation : problem.observations) {
    const ReprojectionCost cost(
        observation.pixel, observation.weight, &rotations[observation.view_idx], &problem.lens);
    const std::array<const double*, 2> blocks = {
        poses[observation.view_idx].data(),
        problem.landmarks[observation.landmark_idx].position_in_map.data()};
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
    std::array<double*, 2> jacobians = {nullptr, by_point.data()};
    if (!cost.Evaluate(blocks.data(), residual.data(), jacobians.data())) continue;
    Sums& sums = residuals.of_landmark[observation.landmark_idx];
    sums.normal += by_point.transpose() * by_point;
    sums.squares += residual.squaredNorm();
    ++sums.num_observations;
    residuals.absolute.push_back(std::abs(residual.x()));
    residuals.absolute.push_back(std::abs(residual.y()));
  }
  return residuals;
}

double FreedomOf(const Sums& sums) { return 2.0 * sums.num_observations - 3.0; }

double ScatterOf(Residuals* residuals) {
  double freedom = 0.0;
  for (const Sums& sums : residuals->of_landmark) freedom += std::max(FreedomOf(sums), 0.0);
  if (freedom <= 0.0) return 0.0;
  auto& absolute = residuals->absolute;
  const auto middle = absolute.begin() + static_cast<std::ptrdiff_t>(absolute.size() / 2);
  std::nth_element(absolute.begin(), middle, absolute.end());
  return kSigmaPerMad * *middle * std::sqrt(static_cast<double>(absolute.size()) / freedom);
}

// Scale of the landmark's finest feature, on the facade [map units].
double FootprintOf(const Map& map, const LensParameters<double>& lens, const Landmark& landmark) {
  double finest = std::numeric_limits<double>::infinity();
  for (const Observation& observation : landmark.track) {
    const View& view = map.view(observation.photo);
    const double depth = (view.cam_from_map * landmark.position_in_map).z();
    const double scale_px = view.features->features[observation.feature_idx].scale_px;
    finest = std::min(finest, scale_px * depth / std::sqrt(lens[kFx] * lens[kFy]));
  }
  return finest;
}

}  // namespace

double LandmarkAccuracy::RaySigma() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(ray_covariance,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(solver.eigenvalues()[2], 0.0));
}

double LandmarkAccuracy::Sigma() const { return std::hypot(RaySigma(), relief_sigma); }

AccuracyPrediction PredictLandmarkAccuracy(const Map& map, const LensParameters<double>& lens) {
  const BundleProblem problem = MakeGlobalBundle({}, map, lens);
  Residuals residuals = Evaluate(problem);
  AccuracyPrediction prediction;
  prediction.sigma_px = ScatterOf(&residuals);
  const double variance = std::pow(prediction.sigma_px, 2);
  for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
    const Sums& sums = residuals.of_landmark[i];
    if (sums.num_observations < 2) continue;
    bool is_determined = false;
    Eigen::Matrix3d inverse;
    sums.normal.computeInverseWithCheck(inverse, is_determined, 0.0);
    if (!is_determined || !inverse.allFinite()) continue;
    const double own =
        (kPriorFreedom * variance + sums.squares) / (kPriorFreedom + FreedomOf(sums));
    const LandmarkId id = problem.landmarks[i].id;
    prediction.landmarks.push_back({id,
                                    std::max(variance, own) * inverse,
                                    kReliefPerFootprint * FootprintOf(map, lens, map.landmark(id)),
                                    sums.num_observations});
  }
  return prediction;
}

}  // namespace plumb
