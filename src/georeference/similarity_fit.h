// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "plumbline/georeference/robust_similarity.h"

namespace plumb {

// A similarity by weighted least squares, with the covariance of RobustSimilarity.
struct SimilarityFit {
  Similarity3 target_from_source;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // In the source.
  Matrix7d covariance = Matrix7d::Zero();
};

// Covariance of a pair's residual: both sides' and the map's bend.
Eigen::Matrix3d ResidualCovariance(const PointPair& pair,
                                   const Similarity3& target_from_source,
                                   double bend_sigma);

// The residual over its standard deviation, the mean of the three axes.
double NormalizedError(const PointPair& pair,
                       const Similarity3& target_from_source,
                       const Eigen::Matrix3d& covariance);

// Change of target_from_source * point by the seven unknowns of RobustSimilarity::covariance.
Eigen::Matrix<double, 3, 7> SimilarityJacobian(const Similarity3& target_from_source,
                                               const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& point_in_source);

// Gauss-Newton from the unweighted similarity, over the pairs with these indices. Nothing if they
// do not determine one.
std::optional<SimilarityFit> FitSimilarity(const std::vector<PointPair>& pairs,
                                           const std::vector<int>& idxs,
                                           double bend_sigma);

// The bend with which the residuals are as large as they should be (chi-square over its freedom is
// one), at least 0. 0 without redundancy.
double MeasureBend(const std::vector<PointPair>& pairs,
                   const std::vector<int>& idxs,
                   const Similarity3& target_from_source);

}  // namespace plumb
