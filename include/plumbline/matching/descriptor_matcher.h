// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plumbline/image/features.h"
#include "plumbline/matching/matcher_options.h"

namespace plumb {

// Indices of two features of two photos.
struct FeatureMatch {
  std::uint32_t idx1 = 0;
  std::uint32_t idx2 = 0;
  bool is_distinct = true;  // Passes max_ratio.
};

// Exact nearest neighbours in both directions, with Lowe's ratio test and the mutual test.
// Ordered by idx1. The same on every processor: integer arithmetic. Thread-safe.
std::vector<FeatureMatch> MatchDescriptors(const MatcherOptions& options,
                                           const DescriptorMatrix& descriptors1,
                                           const DescriptorMatrix& descriptors2);

// The same with max_wide_ratio in place of max_ratio, where that is greater.
std::vector<FeatureMatch> MatchDescriptorsWidely(const MatcherOptions& options,
                                                 const DescriptorMatrix& descriptors1,
                                                 const DescriptorMatrix& descriptors2);

// MatchDescriptors with only the first (largest) `max_features` rows of each.
std::vector<FeatureMatch> MatchLargestFeatures(const MatcherOptions& options,
                                               const DescriptorMatrix& descriptors1,
                                               const DescriptorMatrix& descriptors2,
                                               int max_features);

// Squared Euclidean distance of two descriptors of kDescriptorSize bytes.
std::int32_t SquaredDistance(const std::uint8_t* descriptor1, const std::uint8_t* descriptor2);

}  // namespace plumb
