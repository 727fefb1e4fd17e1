// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/match_graph.h"

#include <algorithm>

#include "plumbline/common/check.h"

namespace plumb {

const std::vector<FeatureMatch>& MatchGraph::Match(const PhotoRecord& photo1,
                                                   const PhotoRecord& photo2) {
  PLUMB_CHECK(photo1.id != photo2.id);
  const Pair pair{photo1.id.value, photo2.id.value};
  const auto known = matches_.find(pair);
  if (known != matches_.end()) return known->second;

  std::vector<FeatureMatch> matches =
      MatchDescriptors(options_, photo1.features->descriptors, photo2.features->descriptors);
  std::vector<FeatureMatch> reversed;
  reversed.reserve(matches.size());
  for (const FeatureMatch& match : matches) reversed.push_back({match.idx2, match.idx1});
  std::sort(reversed.begin(), reversed.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.idx1 < b.idx1;
  });
  Connect(photo1.id, photo2.id, matches);
  Connect(photo2.id, photo1.id, reversed);
  matches_.emplace(Pair{pair.second, pair.first}, std::move(reversed));
  return matches_.emplace(pair, std::move(matches)).first->second;
}

void MatchGraph::Connect(PhotoId photo1, PhotoId photo2, const std::vector<FeatureMatch>& matches) {
  for (const FeatureMatch& match : matches) {
    matches_of_feature_[{photo1.value, match.idx1}].push_back({photo2, match.idx2});
  }
}

const std::vector<Observation>& MatchGraph::MatchesOf(const Observation& observation) const {
  static const std::vector<Observation> kNone;
  const auto it = matches_of_feature_.find({observation.photo.value, observation.feature_idx});
  return it == matches_of_feature_.end() ? kNone : it->second;
}

}  // namespace plumb
