// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>

#include "sfm/lookalike_place.h"
#include "sfm/mapper_impl.h"
#include "sfm/track_geometry.h"

namespace plumb {
namespace {

// The reason nearest to success tells the pilot most.
int Nearness(RefusalReason reason) {
  switch (reason) {
    case RefusalReason::kNoParallax:
      return 3;
    case RefusalReason::kAmbiguous:
      return 2;
    case RefusalReason::kTooFewInliers:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

const PairAttempt& Mapper::Impl::TryPair(PhotoId photo1, PhotoId photo2) {
  const auto [it, is_new] = pair_attempts_.try_emplace({photo1, photo2});
  if (is_new) {
    const PhotoRecord& record1 = records_.at(photo1);
    const PhotoRecord& record2 = records_.at(photo2);
    const std::vector<FeatureMatch>& matches = matches_.Match(record1, record2);
    it->second = TryInitialPair(options_.bootstrap, camera_, record1, record2, matches);
    if (it->second.pair && IsLookalikePair(record1, record2, it->second.pair->cam2_from_cam1)) {
      it->second = {std::nullopt, RefusalReason::kAmbiguous};
    }
  }
  return it->second;
}

bool Mapper::Impl::IsLookalikePair(const PhotoRecord& photo1,
                                   const PhotoRecord& photo2,
                                   const Rigid3& cam2_from_cam1) {
  const std::vector<SeenPoint> points = PairAsSeen(camera_,
                                                   photo1,
                                                   photo2,
                                                   matches_.Match(photo1, photo2),
                                                   cam2_from_cam1,
                                                   options_.bootstrap.max_error_px);
  const double share = LookalikeShare(options_.lookalike, camera_, photo2, points, cam2_from_cam1);
  return IsLookalike(share, [&] { return AreTakenInTurn(photo1.id, photo2.id); });
}

// True if one is the next after the other, of those that could be analysed.
bool Mapper::Impl::AreTakenInTurn(PhotoId photo1, PhotoId photo2) const {
  const auto [earlier, later] = std::minmax(photo1, photo2);
  return earlier < later && std::next(records_.find(earlier)) == records_.find(later);
}

// The earlier photos that look most like it, most alike first.
std::vector<PhotoId> Mapper::Impl::LikestPhotos(PhotoId photo) const {
  std::vector<PhotoId> photos;
  const int num_wanted = options_.bootstrap.max_partners + 1;
  for (const RankedView& ranked :
       retrieval_.Query(records_.at(photo).features->descriptors, num_wanted)) {
    if (ranked.photo != photo) photos.push_back(ranked.photo);
  }
  return photos;
}

// The best pair of the photo and the earlier ones that look most like it.
std::optional<InitialPair> Mapper::Impl::BestPairWith(PhotoId photo, PairSearch* search) {
  std::optional<InitialPair> best;
  search->partners = LikestPhotos(photo);
  for (const PhotoId partner : search->partners) {
    const PairAttempt& attempt = TryPair(partner, photo);
    if (!attempt.pair) {
      if (Nearness(attempt.reason) >= Nearness(search->reason)) search->reason = attempt.reason;
      continue;
    }
    if (!best || attempt.pair->score > best->score) best = attempt.pair;
  }
  return best;
}

// What the map stands on, the photo's own part left out: its best pair of views.
std::optional<InitialPair> Mapper::Impl::BestPairOfMapWithout(PhotoId photo) {
  std::optional<InitialPair> best;
  for (const auto& [photo1, view1] : map_.views()) {
    for (const auto& [photo2, view2] : map_.views()) {
      if (!(photo1 < photo2) || photo1 == photo || photo2 == photo) continue;
      const PairAttempt& attempt = TryPair(photo1, photo2);
      if (!attempt.pair) continue;
      if (!best || attempt.pair->score > best->score) best = attempt.pair;
    }
  }
  return best;
}

void Mapper::Impl::TryStart(PhotoId photo) {
  PairSearch search;
  const auto pair = BestPairWith(photo, &search);
  if (pair) {
    StartFrom(*pair);
    return;
  }
  Location nowhere;
  nowhere.views = search.partners;
  const bool is_first = records_.size() == 1;  // That could be analysed.
  PublishRefusal(
      photo, is_first ? RefusalReason::kNone : search.reason, VerdictStatus::kWaiting, nowhere);
}

// A young map gives way to one from a better pair: its first pair may have had little parallax
// or shown something else than the facade.
void Mapper::Impl::ReconsiderStart(PhotoId photo) {
  if (static_cast<int>(map_.views().size()) > options_.bootstrap.max_young_views) return;
  const auto start = BestPairOfMapWithout(photo);
  if (!start) return;
  const bool is_outside = !map_.HasView(photo);
  const bool is_good = start->parallax_deg >= options_.bootstrap.good_parallax_deg;
  if (is_good && !is_outside) return;
  PairSearch search;
  const auto pair = BestPairWith(photo, &search);
  if (!pair) return;
  const bool is_better = pair->score > options_.bootstrap.min_score_gain * start->score;
  const bool is_outnumbered = !map_.HasView(pair->photo1) && !map_.HasView(pair->photo2) &&
                              PendingPhotos().size() > map_.views().size();
  if (is_better || is_outnumbered) StartFrom(*pair);
}

// What the map holds of a view, as if it had just been located.
Mapper::Impl::Location Mapper::Impl::LocationInMap(PhotoId photo, int num_matches) const {
  Location location;
  location.localization.num_matches = num_matches;
  const View& view = map_.view(photo);
  std::vector<double> errors;
  for (std::uint32_t i = 0; i < view.landmark_of_feature.size(); ++i) {
    const LandmarkId id = view.landmark_of_feature[i];
    if (!id.IsValid()) continue;
    location.localization.inliers.push_back({i, id});
    errors.push_back(
        *ReprojectionError(camera_, map_, {photo, i}, map_.landmark(id).position_in_map));
  }
  std::sort(errors.begin(), errors.end());
  if (!errors.empty()) location.localization.median_error_px = errors[errors.size() / 2];
  return location;
}

void Mapper::Impl::StartFrom(const InitialPair& pair) {
  background_.Cancel();
  std::vector<PhotoId> left_behind;
  for (const auto& [photo, view] : map_.views()) {
    if (photo != pair.photo1 && photo != pair.photo2) left_behind.push_back(photo);
  }
  map_ = Map::SuccessorOf(map_);
  num_views_at_last_bundle_ = 2;

  const Rigid3 cam1_from_map = FirstCameraFromMap();
  AddViewAt(pair.photo1, cam1_from_map);
  AddViewAt(pair.photo2, pair.cam2_from_cam1 * cam1_from_map);
  ExpandFrom(pair.photo2, {pair.photo1});
  const int num_matches =
      static_cast<int>(matches_.Match(records_.at(pair.photo1), records_.at(pair.photo2)).size());
  for (const PhotoId photo : {pair.photo1, pair.photo2}) {
    PublishAccepted(photo, LocationInMap(photo, num_matches));
  }
  Extend(pair.photo2);
  for (const PhotoId photo : left_behind) {
    states_.at(photo).verdict.status = VerdictStatus::kWaiting;
  }
  RetryAllPending();
}

}  // namespace plumb
