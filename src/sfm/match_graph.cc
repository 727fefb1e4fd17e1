// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/match_graph.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// By idx1, then idx2, each pair once, as distinct as the most distinct of its matches.
void SortAndUnite(std::vector<FeatureMatch>* matches) {
  std::sort(matches->begin(), matches->end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    return std::make_tuple(a.idx1, a.idx2, !a.is_distinct) <
           std::make_tuple(b.idx1, b.idx2, !b.is_distinct);
  });
  const auto is_same = [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.idx1 == b.idx1 && a.idx2 == b.idx2;
  };
  matches->erase(std::unique(matches->begin(), matches->end(), is_same), matches->end());
}

}  // namespace

const std::vector<FeatureMatch>& MatchGraph::Match(const PhotoRecord& photo1,
                                                   const PhotoRecord& photo2) {
  return Of(photo1, photo2).counted;
}

const std::vector<FeatureMatch>& MatchGraph::MatchWidely(const PhotoRecord& photo1,
                                                         const PhotoRecord& photo2) {
  return Of(photo1, photo2).all;
}

MatchGraph::PairMatches& MatchGraph::Of(const PhotoRecord& photo1, const PhotoRecord& photo2) {
  PLUMB_CHECK(photo1.id != photo2.id);
  // The ratio test looks from one photo to the other: always from the later one.
  if (photo1.id < photo2.id) {
    Of(photo2, photo1);
    return matches_.at({photo1.id.value, photo2.id.value});
  }
  const Pair pair{photo1.id.value, photo2.id.value};
  const auto known = matches_.find(pair);
  if (known != matches_.end()) return known->second;

  std::vector<FeatureMatch> all =
      MatchDescriptorsWidely(options_, photo1.features->descriptors, photo2.features->descriptors);
  for (FeatureMatch& match : all) {
    match.idx1 = photo1.first_at_spot[match.idx1];
    match.idx2 = photo2.first_at_spot[match.idx2];
  }
  std::vector<FeatureMatch> reversed = all;
  for (FeatureMatch& match : reversed) std::swap(match.idx1, match.idx2);
  PairMatches& backward = matches_[{pair.second, pair.first}];
  backward = Counted(std::move(reversed));
  Connect(photo2.id, photo1.id, backward.counted);
  PairMatches& forward = matches_[pair];
  forward = Counted(std::move(all));
  Connect(photo1.id, photo2.id, forward.counted);
  return forward;
}

MatchGraph::PairMatches MatchGraph::Counted(std::vector<FeatureMatch> all) {
  SortAndUnite(&all);
  PairMatches matches;
  std::copy_if(all.begin(), all.end(), std::back_inserter(matches.counted), [](const auto& match) {
    return match.is_distinct;
  });
  matches.all = std::move(all);
  return matches;
}

void MatchGraph::Widen(PhotoId photo1, PhotoId photo2) {
  for (const auto& [from, to] : {std::make_pair(photo1, photo2), std::make_pair(photo2, photo1)}) {
    PairMatches& matches = matches_.at({from.value, to.value});
    if (matches.counted.size() == matches.all.size()) return;
    std::vector<FeatureMatch> added;
    std::copy_if(
        matches.all.begin(), matches.all.end(), std::back_inserter(added), [](const auto& match) {
          return !match.is_distinct;
        });
    Connect(from, to, added);
    matches.counted = matches.all;
  }
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
