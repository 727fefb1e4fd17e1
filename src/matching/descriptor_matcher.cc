// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/descriptor_matcher.h"

#include <algorithm>

#include "matching/neighbor_search.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

using internal::DescriptorSpan;
using internal::RowNeighbors;

DescriptorSpan FirstRows(const DescriptorMatrix& descriptors, Eigen::Index max_rows) {
  return {descriptors.data(), static_cast<int>(std::min(descriptors.rows(), max_rows))};
}

std::vector<FeatureMatch> Match(const MatcherOptions& options,
                                double max_ratio,
                                const DescriptorSpan& descriptors1,
                                const DescriptorSpan& descriptors2) {
  PLUMB_CHECK(options.Problems().empty());
  const internal::Neighbors neighbors = internal::FindNeighbors(
      internal::BestSimdPath(), descriptors1, descriptors2, options.num_threads);
  const double max_ratio2 = max_ratio * max_ratio;
  const double distinct_ratio2 = options.max_ratio * options.max_ratio;
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < neighbors.rows.size(); ++i) {
    const RowNeighbors& row = neighbors.rows[i];
    if (row.best_idx == internal::kNoNeighbor) continue;
    const auto j = static_cast<std::size_t>(row.best_idx);
    if (neighbors.column_best_idx[j] != static_cast<std::int32_t>(i)) continue;
    if (row.best_distance2 >= max_ratio2 * row.second_distance2) continue;
    const bool is_distinct = row.best_distance2 < distinct_ratio2 * row.second_distance2;
    matches.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), is_distinct});
  }
  return matches;
}

}  // namespace

std::vector<FeatureMatch> MatchDescriptors(const MatcherOptions& options,
                                           const DescriptorMatrix& descriptors1,
                                           const DescriptorMatrix& descriptors2) {
  return Match(options,
               options.max_ratio,
               FirstRows(descriptors1, descriptors1.rows()),
               FirstRows(descriptors2, descriptors2.rows()));
}

std::vector<FeatureMatch> MatchDescriptorsWidely(const MatcherOptions& options,
                                                 const DescriptorMatrix& descriptors1,
                                                 const DescriptorMatrix& descriptors2) {
  return Match(options,
               std::max(options.max_ratio, options.max_wide_ratio),
               FirstRows(descriptors1, descriptors1.rows()),
               FirstRows(descriptors2, descriptors2.rows()));
}

std::vector<FeatureMatch> MatchLargestFeatures(const MatcherOptions& options,
                                               const DescriptorMatrix& descriptors1,
                                               const DescriptorMatrix& descriptors2,
                                               int max_features) {
  PLUMB_CHECK_GE(max_features, 0);
  return Match(options,
               options.max_ratio,
               FirstRows(descriptors1, max_features),
               FirstRows(descriptors2, max_features));
}

}  // namespace plumb
