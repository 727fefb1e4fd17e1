// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plumbline/map/map.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "sfm/photo_record.h"

namespace plumb {

// Which spots of which photos look alike: the matches of all pairs matched so far. Each pair is
// matched once. A spot's first feature stands for all that it has. Not thread-safe.
class MatchGraph {
 public:
  explicit MatchGraph(const MatcherOptions& options) : options_(options) {}

  // The distinct matches of the pair, by idx1, which belongs to `photo1`; all once it was
  // widened.
  const std::vector<FeatureMatch>& Match(const PhotoRecord& photo1, const PhotoRecord& photo2);

  // Also those that are hardly better than the next best, up to options.max_wide_ratio: most are
  // wrong, for a search that can tell.
  const std::vector<FeatureMatch>& MatchWidely(const PhotoRecord& photo1,
                                               const PhotoRecord& photo2);

  // From now on the pair counts with all of these. It must have been matched.
  void Widen(PhotoId photo1, PhotoId photo2);

  // The features matched with this one.
  const std::vector<Observation>& MatchesOf(const Observation& observation) const;

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct PairHash {
    std::size_t operator()(const Pair& pair) const {
      return std::hash<std::uint64_t>{}((std::uint64_t{pair.first} << 32U) | pair.second);
    }
  };
  struct PairMatches {  // By idx1.
    std::vector<FeatureMatch> counted;
    std::vector<FeatureMatch> all;
  };

  PairMatches& Of(const PhotoRecord& photo1, const PhotoRecord& photo2);
  static PairMatches Counted(std::vector<FeatureMatch> all);
  void Connect(PhotoId photo1, PhotoId photo2, const std::vector<FeatureMatch>& matches);

  MatcherOptions options_;
  std::unordered_map<Pair, PairMatches, PairHash> matches_;  // In both directions.
  std::unordered_map<Pair, std::vector<Observation>, PairHash> matches_of_feature_;
};

}  // namespace plumb
