// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/robust_similarity.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "geometry/sampler.h"
#include "georeference/similarity_fit.h"
#include "plumbline/geometry/alignment.h"

namespace plumb {
namespace {

using Indices = std::vector<int>;

// Bound of the search on NormalizedError: four standard deviations on each axis.
constexpr double kSearchBound = 4.0;

// All triples of 19 pairs are 969.
constexpr int kMaxTriples = 1000;

// Of more pairs so many triples are drawn: with half of the pairs wrong one in eight is good.
constexpr int kNumDrawn = 300;

// Leaving one out is tried with no more pairs than this: 60 take 5 ms, and cost grows by the
// square.
constexpr std::size_t kMaxSnoopedPairs = 60;

// With less than five others their scatter says too little.
constexpr std::size_t kMinOthers = 5;

// Points whose width is less than this part of their length count as on a line.
constexpr double kMinWidthRatio = 0.02;

struct Consensus {
  Indices idxs;
  double cost = std::numeric_limits<double>::infinity();
};

class Estimator {
 public:
  Estimator(const RobustSimilarityOptions& options, const std::vector<PointPair>& pairs)
      : options_(options), pairs_(pairs) {
    Eigen::AlignedBox3d box;
    for (const PointPair& pair : pairs) box.extend(pair.in_target);
    max_bend_ = pairs.empty() ? 0.0 : options.max_bend_ratio * box.diagonal().norm();
  }

  RobustSimilarity Run() {
    RobustSimilarity result;
    result.is_good.assign(pairs_.size(), 0);
    if (pairs_.size() < 3) return result;
    result.status = RobustSimilarity::Status::kCollinear;
    if (IsOnLine(All())) return result;
    const Consensus best = Search();
    result.status = RobustSimilarity::Status::kNoAgreement;
    if (best.idxs.size() < 3 || 2 * best.idxs.size() <= pairs_.size()) return result;
    result.status = RobustSimilarity::Status::kCollinear;
    if (IsOnLine(best.idxs)) return result;
    result.is_ambiguous = IsAmbiguous(best);
    Indices good = best.idxs;
    const bool is_snooped = std::isfinite(options_.max_normalized_error);
    while (is_snooped && good.size() > kMinOthers && good.size() <= kMaxSnoopedPairs &&
           DropWorst(&good)) {
    }
    Finish(good, &result);
    return result;
  }

 private:
  Indices All() const {
    Indices idxs(pairs_.size());
    std::iota(idxs.begin(), idxs.end(), 0);
    return idxs;
  }

  // By the source, whose points are the more exact ones.
  bool IsOnLine(const Indices& idxs) const {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(idxs.size()));
    for (std::size_t i = 0; i < idxs.size(); ++i) {
      points.col(static_cast<Eigen::Index>(i)) = Pair(idxs[i]).in_source;
    }
    points.colwise() -= points.rowwise().mean().eval();
    const Eigen::Vector3d extent = Eigen::JacobiSVD<Eigen::Matrix3Xd>(points).singularValues();
    return !(extent[1] > kMinWidthRatio * extent[0]);
  }

  const PointPair& Pair(int idx) const { return pairs_[static_cast<std::size_t>(idx)]; }

  double ErrorOf(int idx, const Similarity3& similarity, double bend) const {
    return NormalizedError(Pair(idx), similarity, ResidualCovariance(Pair(idx), similarity, bend));
  }

  Consensus Evaluate(const Similarity3& similarity) const {
    Consensus consensus;
    consensus.cost = 0.0;
    for (const int idx : All()) {
      const double relative = ErrorOf(idx, similarity, max_bend_) / kSearchBound;
      if (relative < 1.0) consensus.idxs.push_back(idx);
      consensus.cost += std::min(1.0, relative * relative);
    }
    return consensus;
  }

  void TryTriple(const std::array<int, 3>& triple, Consensus* best) {
    const auto similarity = AlignPoints(
        {Pair(triple[0]).in_source, Pair(triple[1]).in_source, Pair(triple[2]).in_source},
        {Pair(triple[0]).in_target, Pair(triple[1]).in_target, Pair(triple[2]).in_target});
    if (!similarity) return;
    Consensus consensus = Evaluate(*similarity);
    tried_.push_back(consensus.idxs);
    if (!(consensus.cost < best->cost)) return;
    *best = consensus;
    for (int i = 0; i < 5; ++i) {
      const auto fit = FitSimilarity(pairs_, best->idxs, max_bend_);
      if (!fit) return;
      consensus = Evaluate(fit->target_from_source);
      if (!(consensus.cost < best->cost)) return;
      *best = consensus;
    }
  }

  Consensus Search() {
    Consensus best;
    const int count = static_cast<int>(pairs_.size());
    const double num_triples = count * (count - 1.0) * (count - 2.0) / 6.0;
    if (num_triples > kMaxTriples) {
      Sampler sampler(options_.random_seed);
      for (int i = 0; i < kNumDrawn; ++i) TryTriple(sampler.Distinct<3>(count), &best);
      return best;
    }
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < i; ++k) {
        for (int m = 0; m < k; ++m) TryTriple({m, k, i}, &best);
      }
    }
    return best;
  }

  // Whether as many pairs agree on something else that takes in a pair which is clearly wrong by
  // the best.
  bool IsAmbiguous(const Consensus& best) const {
    if (best.idxs.size() == pairs_.size()) return false;
    const auto fit = FitSimilarity(pairs_, best.idxs, max_bend_);
    if (!fit) return true;
    return std::any_of(tried_.begin(), tried_.end(), [&](const Indices& other) {
      if (other.size() < best.idxs.size()) return false;
      return std::any_of(other.begin(), other.end(), [&](int idx) {
        return ErrorOf(idx, fit->target_from_source, max_bend_) > 2.0 * kSearchBound;
      });
    });
  }

  // How far a pair is from where the others put it, by what they leave themselves.
  double ErrorByOthers(const Indices& others, int idx) const {
    // A map is never believed to be straighter than this, lest a few pairs that happen to fit well
    // accuse the next.
    const double least_bend = 0.1 * max_bend_;
    const auto start = FitSimilarity(pairs_, others, least_bend);
    if (!start) return 0.0;
    const double bend =
        std::max(least_bend, MeasureBend(pairs_, others, start->target_from_source));
    const auto fit = FitSimilarity(pairs_, others, bend);
    if (!fit) return 0.0;
    const auto jacobian =
        SimilarityJacobian(fit->target_from_source, fit->center, Pair(idx).in_source);
    const Eigen::Matrix3d covariance =
        ResidualCovariance(Pair(idx), fit->target_from_source, bend) +
        jacobian * fit->covariance * jacobian.transpose();
    return NormalizedError(Pair(idx), fit->target_from_source, covariance);
  }

  bool DropWorst(Indices* good) const {
    std::size_t worst = 0;
    double worst_error = 0.0;
    for (std::size_t i = 0; i < good->size(); ++i) {
      Indices others = *good;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const double error = ErrorByOthers(others, (*good)[i]);
      if (!(error > worst_error)) continue;
      worst_error = error;
      worst = i;
    }
    if (worst_error <= options_.max_normalized_error) return false;
    Indices others = *good;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(worst));
    if (2 * others.size() <= pairs_.size() || IsOnLine(others)) return false;
    *good = others;
    return true;
  }

  void Finish(const Indices& good, RobustSimilarity* result) const {
    auto fit = FitSimilarity(pairs_, good, 0.0);
    // The bend changes the weights and the weights the bend.
    for (int i = 0; fit && i < 3; ++i) {
      result->bend_sigma = MeasureBend(pairs_, good, fit->target_from_source);
      fit = FitSimilarity(pairs_, good, result->bend_sigma);
    }
    if (!fit) return;
    result->status = RobustSimilarity::Status::kOk;
    result->target_from_source = fit->target_from_source;
    result->covariance = fit->covariance;
    result->center = fit->center;
    for (const int idx : good) result->is_good[static_cast<std::size_t>(idx)] = 1;
  }

  RobustSimilarityOptions options_;
  const std::vector<PointPair>& pairs_;
  double max_bend_ = 0.0;
  std::vector<Indices> tried_;
};

}  // namespace

RobustSimilarity EstimateRobustSimilarity(const RobustSimilarityOptions& options,
                                          const std::vector<PointPair>& pairs) {
  return Estimator(options, pairs).Run();
}

Eigen::Matrix3d CovarianceAt(const RobustSimilarity& similarity,
                             const Eigen::Vector3d& point_in_source) {
  const auto jacobian =
      SimilarityJacobian(similarity.target_from_source, similarity.center, point_in_source);
  return jacobian * similarity.covariance * jacobian.transpose();
}

}  // namespace plumb
