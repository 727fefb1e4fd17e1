// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/geometry/similarity3.h"

namespace plumb {

// A point known in both frames, with what is uncertain of it in either.
struct PointPair {
  Eigen::Vector3d in_source = Eigen::Vector3d::Zero();
  Eigen::Matrix3d source_covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d in_target = Eigen::Vector3d::Zero();
  Eigen::Matrix3d target_covariance = Eigen::Matrix3d::Zero();
};

struct RobustSimilarityOptions {
  // How far a map may be bent, in parts of the points' extent: pairs that agree to within four
  // times this, beside their own uncertainty, may belong together. The paper's flights were off by
  // 23 mm in 58 m, which is 0.0004.
  double max_bend_ratio = 0.0005;

  // A pair is wrong if it is off by this many times what the others leave. Infinite: that is not
  // looked at.
  double max_normalized_error = 5.0;

  int random_seed = 1;  // Only with more than 19 pairs are triples drawn by chance.
};

using Matrix7d = Eigen::Matrix<double, 7, 7>;

struct RobustSimilarity {
  enum class Status {
    kOk,
    kTooFewPairs,  // Less than three.
    kCollinear,    // All on a line: the rotation about it is free.
    kNoAgreement   // No three, or not more than half of the pairs, agree.
  };

  Status status = Status::kTooFewPairs;
  Similarity3 target_from_source;  // Of the pairs that agree. All below only if kOk.
  std::vector<char> is_good;       // For each pair.
  bool is_ambiguous = false;       // As many others agree on something else.

  // What the good pairs scatter beyond their own uncertainty: the map's bend [target's unit], the
  // same along each axis.
  double bend_sigma = 0.0;

  // Of a turn about the axes of the target [rad], the logarithm of the scale, and the shift, all
  // about `center`, the good pairs' mean in the source.
  Matrix7d covariance = Matrix7d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

// The similarity on which most pairs agree, and which do not. Every three pairs give one (Umeyama,
// TPAMI 13(4), 1991); that with the least truncated cost is refined on those within the bound by
// least squares, each residual weighed by the covariances of both sides. Then what the good pairs
// scatter is measured, and the worst is taken out as long as it is off by more than the others
// allow (data snooping after Baarda, with an estimated variance as in Pope, 1976). Deterministic.
RobustSimilarity EstimateRobustSimilarity(const RobustSimilarityOptions& options,
                                          const std::vector<PointPair>& pairs);

// Covariance of target_from_source * point_in_source that comes from the similarity alone.
Eigen::Matrix3d CovarianceAt(const RobustSimilarity& similarity,
                             const Eigen::Vector3d& point_in_source);

}  // namespace plumb
