// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/sfm/bundle_problem.h"

namespace plumb {

struct LandmarkAccuracy {
  LandmarkId id;
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // [map units^2]
  int num_observations = 0;
};

struct AccuracyPrediction {
  double sigma_px = 0.0;  // Of a coordinate of the finest features, as the residuals tell.
  std::vector<LandmarkAccuracy> landmarks;  // Those whose rays determine them.
};

// How certain each landmark of a solved problem is, given the poses and the lens:
//   C = s^2 (sum over observations of w^2 J' J)^-1,  J = d pixel / d point, w as in the bundle,
//   s^2 = (n0 sigma^2 + sum of squared residuals) / (n0 + freedom), at least sigma^2
// where sigma is the scatter of all residuals (median absolute deviation, freed of what the
// points took up) and n0 = 4 what that counts against the landmark's own, of which there may be but
// one more than it has unknowns. The problem must be without the multi-scale term.
AccuracyPrediction PredictLandmarkAccuracy(const BundleProblem& problem);

}  // namespace plumb
