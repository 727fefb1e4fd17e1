// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/camera/projection.h"
#include "plumbline/common/ids.h"
#include "plumbline/map/map.h"

namespace plumb {

struct LandmarkAccuracy {
  LandmarkId id;
  Eigen::Matrix3d ray_covariance = Eigen::Matrix3d::Zero();  // By rays and noise [map units^2].
  double relief_sigma = 0.0;                                 // By what the patch shows [map units].
  int num_observations = 0;

  // Standard deviation along the least certain direction [map units].
  double Sigma() const;
  double RaySigma() const;
};

struct AccuracyPrediction {
  double sigma_px = 0.0;  // Of a coordinate of the finest features, as the residuals tell.
  std::vector<LandmarkAccuracy> landmarks;  // Those whose rays determine them.
};

// How certain each landmark of a map that was bundled is, given the poses and the lens. By the
// rays:
//   C = s^2 (sum over observations of w^2 J' J)^-1,  J = d pixel / d point, w as in the bundle,
//   s^2 = (n0 sigma^2 + sum of squared residuals) / (n0 + freedom), at least sigma^2
// where sigma is the scatter of all residuals (median absolute deviation, freed of what the
// points took up) and n0 = 4 what that counts against the landmark's own, of which there may be but
// one more than it has unknowns. By the relief: a feature is a patch, and what looks like one spot
// from all sides need not lie on a surface that is uneven within the patch; 0.3 of the finest
// feature's scale on the facade, as measured (docs/bundle.md).
AccuracyPrediction PredictLandmarkAccuracy(const Map& map, const LensParameters<double>& lens);

}  // namespace plumb
