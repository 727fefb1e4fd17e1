// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <unordered_set>

#include "plumbline/common/stopwatch.h"
#include "sfm/covisibility.h"
#include "sfm/expander.h"
#include "sfm/lookalike_place.h"
#include "sfm/mapper_impl.h"
#include "sfm/track_geometry.h"

namespace plumb {
namespace {

// The inverted file ranks all photos, located or not: this many times the wanted views are asked
// for.
constexpr int kRankedPerView = 6;

// A view that scores less than this fraction of the best one's is not suspected to show a twin of
// the place: half of what would make the photo ambiguous, for scores scatter.
constexpr double kMinLikeness = 0.25;

// A view with fewer landmarks is expanded with all matches. With a bound of 600 the walk around
// south_building by every third photo from the first is located whole (43 of 43 instead of 14), and
// photos 0, 4 and 8 of fountain-P11; views of the whole scenes have more.
constexpr int kSparseView = 600;

// Features compared to see whether a refused photo lies near a new view, and the matches
// that make it worth another try.
constexpr int kNumQuickFeatures = 800;
constexpr std::size_t kMinQuickMatches = 12;

// Refused photos compared with each new view: bounds the time per photo.
constexpr std::size_t kMaxPendingCompared = 64;

// Matches of photos that show different things agree on a pose by chance; so few mean nothing.
RefusalReason ReasonOf(const LocalizerOptions& options, const Localization& localization) {
  switch (localization.status) {
    case Localization::Status::kTooFewMatches:
      return RefusalReason::kNoOverlap;
    case Localization::Status::kTooFewInliers:
      return static_cast<int>(localization.inliers.size()) < options.min_num_related_inliers
                 ? RefusalReason::kNoOverlap
                 : RefusalReason::kTooFewInliers;
    case Localization::Status::kAmbiguous:
      return RefusalReason::kAmbiguous;
    case Localization::Status::kOk:
      break;
  }
  return RefusalReason::kNone;
}

}  // namespace

// The views that look like the photo, most alike first.
std::vector<RankedView> Mapper::Impl::RankedMapViews(PhotoId photo) const {
  std::vector<RankedView> views;
  const DescriptorMatrix& descriptors = records_.at(photo).features->descriptors;
  for (const RankedView& ranked :
       retrieval_.Query(descriptors, kRankedPerView * options_.localizer.num_views)) {
    if (map_.HasView(ranked.photo)) views.push_back(ranked);
  }
  return views;
}

// The views that look most like the photo, and the newest: a pilot flies on.
std::vector<PhotoId> Mapper::Impl::CandidateViews(const std::vector<RankedView>& ranked) const {
  std::vector<PhotoId> views;
  for (const RankedView& view : ranked) {
    if (views.size() == static_cast<std::size_t>(options_.localizer.num_views)) break;
    views.push_back(view.photo);
  }
  const PhotoId newest = map_.views().rbegin()->first;
  if (std::find(views.begin(), views.end(), newest) == views.end()) views.push_back(newest);
  return views;
}

// The most alike of the views that the photo was not matched with and that see few of the
// landmarks matched: it looks like the photo for another reason. Where windows repeat, all of the
// matched views may show one place and the photo another: matches with both tell.
std::optional<PhotoId> Mapper::Impl::LikestElsewhere(const std::vector<RankedView>& ranked,
                                                     const Location& location) const {
  if (ranked.size() <= location.views.size()) return std::nullopt;
  std::unordered_set<LandmarkId> matched;
  for (const MapMatch& match : location.matches) matched.insert(match.landmark);
  const auto num_matched = [&](PhotoId photo) {
    const std::vector<LandmarkId>& ids = map_.view(photo).landmark_of_feature;
    return std::count_if(
        ids.begin(), ids.end(), [&](LandmarkId id) { return matched.count(id) != 0; });
  };
  const double enough_for_score = options_.localizer.max_second_pose_ratio *
                                  static_cast<double>(num_matched(ranked[0].photo)) /
                                  ranked[0].score;
  for (const RankedView& view : ranked) {
    if (view.score < kMinLikeness * ranked[0].score) break;
    const bool is_known =
        std::find(location.views.begin(), location.views.end(), view.photo) != location.views.end();
    if (is_known) continue;
    if (static_cast<double>(num_matched(view.photo)) < enough_for_score * view.score) {
      return view.photo;
    }
  }
  return std::nullopt;
}

std::vector<MapMatch> Mapper::Impl::MatchWithViews(PhotoId photo,
                                                   const std::vector<PhotoId>& views,
                                                   MatchReach reach) {
  std::set<std::pair<std::uint32_t, LandmarkId>> seen;
  std::vector<MapMatch> matches;
  for (const PhotoId other : views) {
    const View& view = map_.view(other);
    const PhotoRecord& record1 = records_.at(photo);
    const PhotoRecord& record2 = records_.at(other);
    for (const FeatureMatch& match : reach == MatchReach::kWide
                                         ? matches_.MatchWidely(record1, record2)
                                         : matches_.Match(record1, record2)) {
      const LandmarkId id = view.landmark_of_feature[match.idx2];
      if (!id.IsValid() || !seen.insert({match.idx1, id}).second) continue;
      matches.push_back({match.idx1, id});
    }
  }
  return matches;
}

// By distinct matches; by all where those do not do: far from its neighbours a photo has few, and
// the search for a pose tells the right ones.
Mapper::Impl::Location Mapper::Impl::Locate(PhotoId photo) {
  Stopwatch stopwatch;
  const std::vector<RankedView> ranked = RankedMapViews(photo);
  Location location;
  location.views = CandidateViews(ranked);
  states_.at(photo).verdict.seconds.retrieval_s += stopwatch.Seconds();
  LocateByMatches(photo, ranked, MatchReach::kDistinct, &location);
  const Localization::Status status = location.localization.status;
  if (status == Localization::Status::kOk || status == Localization::Status::kAmbiguous) {
    return location;
  }
  Location wide;
  wide.views = location.views;
  LocateByMatches(photo, ranked, MatchReach::kWide, &wide);
  const bool is_better = wide.localization.status == Localization::Status::kOk ||
                         wide.localization.inliers.size() > location.localization.inliers.size();
  return is_better ? wide : location;
}

void Mapper::Impl::LocateByMatches(PhotoId photo,
                                   const std::vector<RankedView>& ranked,
                                   MatchReach reach,
                                   Location* location) {
  StageSeconds& seconds = states_.at(photo).verdict.seconds;
  Stopwatch stopwatch;
  location->reach = reach;
  location->matches = MatchWithViews(photo, location->views, reach);
  if (const auto elsewhere = LikestElsewhere(ranked, *location)) {
    location->views.push_back(*elsewhere);
    location->matches = MatchWithViews(photo, location->views, reach);
  }
  seconds.matching_s += stopwatch.Restart();
  const PhotoRecord& record = records_.at(photo);
  location->localization =
      LocalizePhoto(options_.localizer, camera_, map_, record, location->matches);
  if (location->localization.status == Localization::Status::kOk) {
    ExtendByGuidedMatching(
        options_.localizer, camera_, map_, record, location->views, &location->localization);
    RefuseLookalike(photo, location);
  }
  seconds.pose_s += stopwatch.Restart();
}

void Mapper::Impl::RefuseLookalike(PhotoId photo, Location* location) {
  const PhotoRecord& record = records_.at(photo);
  Localization& localization = location->localization;
  const double share = LookalikeShare(options_.lookalike,
                                      camera_,
                                      record,
                                      InliersAsSeen(map_, record, location->views, localization),
                                      localization.cam_from_map);
  if (IsLookalike(share, [&] { return IsBesideNeighbor(photo, localization); })) {
    localization.status = Localization::Status::kAmbiguous;
  }
}

// Windows that have misled once may mislead again: from then on only neighbours count.
bool Mapper::Impl::IsLookalike(double share, const std::function<bool()>& has_neighbor) {
  if (share >= options_.lookalike.max_found_share) {
    windows_repeat_ = true;
    return true;
  }
  const bool is_suspect = windows_repeat_ || share >= options_.lookalike.max_unsupported_share;
  return is_suspect && !has_neighbor();
}

// True if the photo taken before or after it sees a good part of its landmarks.
bool Mapper::Impl::IsBesideNeighbor(PhotoId photo, const Localization& localization) const {
  const double enough =
      options_.lookalike.min_neighbor_share * static_cast<double>(localization.inliers.size());
  return std::any_of(map_.views().begin(), map_.views().end(), [&](const auto& entry) {
    if (!AreTakenInTurn(photo, entry.first)) return false;
    const auto is_seen = [&](const MapMatch& match) {
      return IsSeenIn(map_.landmark(match.landmark).track, entry.first);
    };
    const auto num_seen =
        std::count_if(localization.inliers.begin(), localization.inliers.end(), is_seen);
    return static_cast<double>(num_seen) >= enough;
  });
}

bool Mapper::Impl::TryAccept(PhotoId photo) {
  const Location location = Locate(photo);
  if (location.localization.status != Localization::Status::kOk) {
    PublishRefusal(photo,
                   ReasonOf(options_.localizer, location.localization),
                   VerdictStatus::kRefused,
                   location);
    return false;
  }
  PublishAccepted(photo, location);
  AddViewAt(photo, location.localization.cam_from_map);
  for (const MapMatch& match : location.localization.inliers) {
    map_.AddObservation(match.landmark, {photo, match.feature_idx});
  }
  Stopwatch stopwatch;
  ExpandFrom(photo, location.views);
  states_.at(photo).verdict.seconds.expand_s = stopwatch.Seconds();
  Extend(photo);
  return true;
}

void Mapper::Impl::AddViewAt(PhotoId photo, const Rigid3& cam_from_map) {
  const PhotoRecord& record = records_.at(photo);
  map_.AddView(photo, {record.name, record.exposure_time, cam_from_map, record.features, {}, 0});
}

bool Mapper::Impl::IsSparse(PhotoId photo) const {
  return map_.view(photo).num_observations < kSparseView;
}

// Where the views are far apart the distinct matches give few landmarks, too few for the next
// photo. The poses known, all matches may be tried: most of the wrong ones miss their epipolar
// line.
void Mapper::Impl::ExpandFrom(PhotoId photo, const std::vector<PhotoId>& views) {
  ExpandMap(options_.expander, camera_, matches_, records_, photo, &map_);
  if (!IsSparse(photo)) return;
  for (const PhotoId view : views) matches_.Widen(photo, view);
  ExpandMap(options_.expander, camera_, matches_, records_, photo, &map_);
}

// Settles a new view among its neighbours.
void Mapper::Impl::Extend(PhotoId photo) {
  StageSeconds& seconds = states_.at(photo).verdict.seconds;
  Stopwatch stopwatch;
  BundleProblem problem = MakeLocalBundle(options_.bundle, map_, camera_.lens(), photo);
  BundleOptions options = options_.bundle;
  options.refine_focal_length = false;  // Too few views to tell the lens from the poses.
  options.refine_principal_point = false;
  options.refine_distortion = false;
  const BundleReport report = SolveBundle(
      options, options.max_local_iterations, options.function_tolerance, nullptr, &problem);
  if (report.is_usable) ApplyBundle(problem, &map_);
  seconds.bundle_s = stopwatch.Restart();

  std::vector<LandmarkId> touched;
  for (const BundleLandmark& landmark : problem.landmarks) touched.push_back(landmark.id);
  for (const LandmarkId id : map_.view(photo).landmark_of_feature) {
    if (id.IsValid()) touched.push_back(id);
  }
  CullLandmarks(options_.expander, camera_, touched, &map_);
  seconds.expand_s += stopwatch.Seconds();
  EmitDelta();
  listener_->OnSeconds(photo, seconds);
  QueueRetriesNear(photo);
}

void Mapper::Impl::QueueRetriesNear(PhotoId photo) {
  const std::vector<PhotoId> pending = PendingPhotos();
  const std::size_t first =
      pending.size() > kMaxPendingCompared ? pending.size() - kMaxPendingCompared : 0;
  for (std::size_t i = first; i < pending.size(); ++i) {
    if (pending[i] == photo) continue;
    if (std::find(retry_queue_.begin(), retry_queue_.end(), pending[i]) != retry_queue_.end())
      continue;
    const std::size_t num_matches =
        MatchLargestFeatures(options_.matcher,
                             records_.at(pending[i]).features->descriptors,
                             records_.at(photo).features->descriptors,
                             kNumQuickFeatures)
            .size();
    if (num_matches >= kMinQuickMatches) retry_queue_.push_back(pending[i]);
  }
}

void Mapper::Impl::RetryQueued(int max_retries) {
  for (int i = 0; i < max_retries && !retry_queue_.empty(); ++i) {
    const PhotoId photo = retry_queue_.front();
    retry_queue_.erase(retry_queue_.begin());
    if (IsPending(photo)) TryAccept(photo);
  }
}

// Tries all until none fits any more. True if any did.
bool Mapper::Impl::RetryAllPending() {
  bool has_grown = false;
  for (bool grows = true; grows;) {
    grows = false;
    for (const PhotoId photo : PendingPhotos()) grows = TryAccept(photo) || grows;
    has_grown = has_grown || grows;
  }
  return has_grown;
}

}  // namespace plumb
