// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plumbline/map/map.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "sfm/photo_record.h"

namespace plumb {

// Which features of which photos look alike: the matches of all pairs matched so far. Each
// pair is matched once. Not thread-safe.
class MatchGraph {
 public:
  explicit MatchGraph(const MatcherOptions& options) : options_(options) {}

  // Matches the pair unless that was done; idx1 belongs to `photo1`.
  const std::vector<FeatureMatch>& Match(const PhotoRecord& photo1, const PhotoRecord& photo2);

  // The features matched with this one.
  const std::vector<Observation>& MatchesOf(const Observation& observation) const;

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct PairHash {
    std::size_t operator()(const Pair& pair) const {
      return std::hash<std::uint64_t>{}((std::uint64_t{pair.first} << 32U) | pair.second);
    }
  };

  void Connect(PhotoId photo1, PhotoId photo2, const std::vector<FeatureMatch>& matches);

  MatcherOptions options_;
  std::unordered_map<Pair, std::vector<FeatureMatch>, PairHash> matches_;  // In both directions.
  std::unordered_map<Pair, std::vector<Observation>, PairHash> matches_of_feature_;
};

}  // namespace plumb
