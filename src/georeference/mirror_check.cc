// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/mirror_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "georeference/similarity_fit.h"

namespace plumb {
namespace {

// Three always fit either way.
constexpr int kMinPairs = 4;

// Of the mean squared errors. Of 6400 simulated surveys of 4 to 12 targets that lay up to 0.3 m off
// a plane, half of them with maps bent by some 20 mm, none was accused; by 16 two were.
constexpr double kClearlyBetter = 25.0;

double SquaredError(const PointPair& pair, const Similarity3& target_from_source) {
  const double error = NormalizedError(
      pair, target_from_source, ResidualCovariance(pair, target_from_source, /*bend_sigma=*/0.0));
  return error * error;
}

struct Misfit {
  double squared_error = 0.0;  // Mean, in squared standard deviations.
  double rms_m = 0.0;
};

Misfit MisfitOf(const std::vector<PointPair>& pairs,
                const std::vector<char>& is_good,
                const Similarity3& target_from_source) {
  Misfit misfit;
  int count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (is_good[i] == 0) continue;
    ++count;
    misfit.squared_error += SquaredError(pairs[i], target_from_source);
    misfit.rms_m += (target_from_source * pairs[i].in_source - pairs[i].in_target).squaredNorm();
  }
  misfit.squared_error /= count;
  misfit.rms_m = std::sqrt(misfit.rms_m / count);
  return misfit;
}

int NumGood(const RobustSimilarity& similarity) {
  return static_cast<int>(
      std::count(similarity.is_good.begin(), similarity.is_good.end(), char{1}));
}

}  // namespace

std::optional<MirrorImage> FindMirrorImage(const RobustSimilarityOptions& options,
                                           const std::vector<PointPair>& pairs,
                                           const RobustSimilarity& as_they_stand) {
  const bool is_fit = as_they_stand.status == RobustSimilarity::Status::kOk;
  if (is_fit && std::all_of(pairs.begin(), pairs.end(), [&](const PointPair& pair) {
        return SquaredError(pair, as_they_stand.target_from_source) <= kClearlyBetter;
      })) {
    return std::nullopt;  // No other can be so much better.
  }
  std::vector<PointPair> mirrored_pairs = pairs;
  for (PointPair& pair : mirrored_pairs) std::swap(pair.in_target.x(), pair.in_target.y());
  const RobustSimilarity mirrored = EstimateRobustSimilarity(options, mirrored_pairs);
  if (mirrored.status != RobustSimilarity::Status::kOk) return std::nullopt;
  MirrorImage image;
  image.num_pairs = NumGood(mirrored);
  const Misfit of_mirrored =
      MisfitOf(mirrored_pairs, mirrored.is_good, mirrored.target_from_source);
  image.mirrored_rms_m = of_mirrored.rms_m;
  if (!is_fit) return image;
  if (image.num_pairs < std::max(kMinPairs, NumGood(as_they_stand))) return std::nullopt;
  const Misfit misfit = MisfitOf(pairs, mirrored.is_good, as_they_stand.target_from_source);
  image.rms_m = misfit.rms_m;
  // Nothing is believed to fit better than to its standard deviation.
  if (misfit.squared_error <= kClearlyBetter * std::max(1.0, of_mirrored.squared_error)) {
    return std::nullopt;
  }
  return image;
}

}  // namespace plumb
