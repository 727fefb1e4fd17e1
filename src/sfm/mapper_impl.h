// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plumbline/common/stopwatch.h"
#include "plumbline/matching/view_retrieval.h"
#include "plumbline/sfm/mapper.h"
#include "sfm/background_bundle.h"
#include "sfm/bootstrap.h"
#include "sfm/localizer.h"
#include "sfm/match_graph.h"
#include "sfm/photo_record.h"

namespace plumb {

class Mapper::Impl {
 public:
  Impl(const MapperOptions& options, const Camera& camera, MapperListener* listener);

  void Add(MapperPhoto photo);
  void Poll();
  void Finish();
  void SetConstraints(BundleConstraints constraints) { constraints_ = std::move(constraints); }
  void Restore(std::vector<MapperPhoto> photos,
               const std::vector<PhotoVerdict>& verdicts,
               const MapDelta& snapshot);

  const Map& map() const { return map_; }
  const Camera& camera() const { return camera_; }

 private:
  struct PhotoState {
    PhotoVerdict verdict;
    std::uint64_t content_hash = 0;
  };

  enum class MatchReach { kDistinct, kWide };

  struct Location {
    Localization localization;
    MatchReach reach = MatchReach::kDistinct;
    std::vector<MapMatch> matches;  // All that were tried.
    std::vector<PhotoId> views;     // Those it was matched with, most alike first.
  };

  struct PairSearch {
    std::vector<PhotoId> partners;  // Most alike first.
    RefusalReason reason = RefusalReason::kNoOverlap;
  };

  // Verdicts (mapper_verdicts.cc).
  bool RefuseWithoutMap(const MapperPhoto& photo);
  PhotoVerdict NewVerdict(PhotoId photo) const;
  void Publish(PhotoVerdict verdict);
  void PublishRefusal(PhotoId photo,
                      RefusalReason reason,
                      VerdictStatus status,
                      const Location& location);
  void PublishAccepted(PhotoId photo, const Location& location);
  void SetPixels(const Location& location, PhotoVerdict* verdict) const;
  bool IsPending(PhotoId photo) const;
  std::vector<PhotoId> PendingPhotos() const;
  void EmitDelta();

  // Start of the map (mapper_start.cc).
  std::optional<InitialPair> BestPairWith(PhotoId photo, PairSearch* search);
  const PairAttempt& TryPair(PhotoId photo1, PhotoId photo2);
  bool AreTakenInTurn(PhotoId photo1, PhotoId photo2) const;
  bool IsLookalikePair(const PhotoRecord& photo1,
                       const PhotoRecord& photo2,
                       const Rigid3& cam2_from_cam1);
  std::optional<InitialPair> BestPairOfMapWithout(PhotoId photo);
  std::vector<PhotoId> LikestPhotos(PhotoId photo) const;
  void TryStart(PhotoId photo);
  void ReconsiderStart(PhotoId photo);
  void StartFrom(const InitialPair& pair);
  Location LocationInMap(PhotoId photo, int num_matches) const;

  // One photo in a map (mapper_steps.cc).
  std::vector<RankedView> RankedMapViews(PhotoId photo) const;
  std::vector<PhotoId> CandidateViews(const std::vector<RankedView>& ranked) const;
  std::optional<PhotoId> LikestElsewhere(const std::vector<RankedView>& ranked,
                                         const Location& location) const;
  std::vector<MapMatch> MatchWithViews(PhotoId photo,
                                       const std::vector<PhotoId>& views,
                                       MatchReach reach);
  Location Locate(PhotoId photo);
  void LocateByMatches(PhotoId photo,
                       const std::vector<RankedView>& ranked,
                       MatchReach reach,
                       Location* location);
  void RefuseLookalike(PhotoId photo, Location* location);
  bool IsLookalike(double share, const std::function<bool()>& has_neighbor);
  bool IsBesideNeighbor(PhotoId photo, const Localization& localization) const;
  bool TryAccept(PhotoId photo);
  void AddViewAt(PhotoId photo, const Rigid3& cam_from_map);
  bool IsSparse(PhotoId photo) const;
  void ExpandFrom(PhotoId photo, const std::vector<PhotoId>& views);
  void Extend(PhotoId photo);
  void QueueRetriesNear(PhotoId photo);
  void RetryQueued(int max_retries);
  bool RetryAllPending();

  // The whole map (mapper.cc).
  BundleProblem GlobalBundle() const;
  void ManageBackground();
  void TakeBackground();
  bool AdoptLens(const LensParameters<double>& lens);
  void FinalBundle();

  // After Restore (mapper_restore.cc).
  void QueueUnmatchedPairs();
  void MatchQueuedPairs(std::size_t max_pairs);

  MapperOptions options_;
  Camera camera_;
  MapperListener* listener_;

  PhotoRecords records_;  // Of every photo that could be analysed.
  std::map<PhotoId, PhotoState> states_;
  std::unordered_map<std::uint64_t, PhotoId> photo_of_hash_;
  ViewRetrieval retrieval_;
  MatchGraph matches_;
  Map map_;
  std::map<std::pair<PhotoId, PhotoId>, PairAttempt> pair_attempts_;
  std::vector<PhotoId> retry_queue_;
  bool windows_repeat_ = false;                               // A photo fitted a second place.
  std::vector<std::pair<PhotoId, PhotoId>> unmatched_pairs_;  // Of a restored map.

  BundleConstraints constraints_;
  BackgroundBundle background_;
  std::size_t num_photos_ = 0;  // Added so far; the clock of deterministic runs.
  std::size_t background_start_ = 0;
  std::size_t num_views_at_last_bundle_ = 0;
  Stopwatch since_add_;
};

}  // namespace plumb
