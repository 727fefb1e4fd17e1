// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/expander.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "plumbline/geometry/relative_pose.h"
#include "sfm/track_geometry.h"

namespace plumb {
namespace {

constexpr double kDegree = M_PI / 180.0;

class Expander {
 public:
  Expander(const ExpanderOptions& options,
           const Camera& camera,
           const MatchGraph& matches,
           Map* map)
      : options_(options), camera_(camera), matches_(matches), map_(*map) {}

  void ExpandFeature(const PhotoRecords& photos, const Observation& observation) {
    const std::vector<Observation> candidates = EpipolarCandidates(photos, observation);
    if (candidates.empty()) return;
    for (const Observation& candidate : candidates) {
      const LandmarkId other = map_.LandmarkOf(candidate);
      if (other.IsValid()) JoinLandmark(observation, other);
    }
    const LandmarkId own = map_.LandmarkOf(observation);
    if (own.IsValid()) {
      AddFitting(own, candidates);
    } else {
      Triangulate(photos, observation, candidates);
    }
  }

  // Walks the matches of the track's features, also of those that join on the way.
  void CompleteTrack(LandmarkId id) {
    for (std::size_t i = 0; i < map_.landmark(id).track.size(); ++i) {
      const Observation observation = map_.landmark(id).track[i];
      for (const Observation& candidate : matches_.MatchesOf(observation)) {
        if (!map_.HasView(candidate.photo)) continue;
        const LandmarkId other = map_.LandmarkOf(candidate);
        if (!other.IsValid()) {
          AddFitting(id, {candidate});
        } else if (other != id) {
          TryMerge(id, other);
        }
      }
    }
  }

  const ExpansionReport& report() const { return report_; }

 private:
  std::vector<Observation> EpipolarCandidates(const PhotoRecords& photos,
                                              const Observation& observation) {
    const Eigen::Vector2d& xy = photos.at(observation.photo).normalized[observation.feature_idx];
    const double max_error = options_.max_epipolar_error_px / camera_.MeanFocalLength();
    std::vector<Observation> candidates;
    for (const Observation& candidate : matches_.MatchesOf(observation)) {
      if (!map_.HasView(candidate.photo)) continue;
      const Eigen::Vector2d& other_xy =
          photos.at(candidate.photo).normalized[candidate.feature_idx];
      const Eigen::Matrix3d& essential = Essential(observation.photo, candidate.photo);
      if (SampsonError(essential, xy, other_xy) <= max_error) candidates.push_back(candidate);
    }
    return candidates;
  }

  const Eigen::Matrix3d& Essential(PhotoId photo1, PhotoId photo2) {
    const auto [it, is_new] = essentials_.try_emplace({photo1, photo2});
    if (is_new) {
      it->second = EssentialFromPose(map_.view(photo2).cam_from_map *
                                     map_.view(photo1).cam_from_map.Inverse());
    }
    return it->second;
  }

  // The feature's match belongs to a landmark: so does the feature, or both landmarks are one.
  void JoinLandmark(const Observation& observation, LandmarkId other) {
    const LandmarkId own = map_.LandmarkOf(observation);
    if (!own.IsValid()) {
      AddFitting(other, {observation});
    } else if (own != other) {
      TryMerge(own, other);
    }
  }

  void AddFitting(LandmarkId id, const std::vector<Observation>& candidates) {
    for (const Observation& candidate : candidates) {
      if (map_.LandmarkOf(candidate).IsValid()) continue;
      const Landmark& landmark = map_.landmark(id);
      if (IsSeenIn(landmark.track, candidate.photo)) continue;
      const auto error = ReprojectionError(camera_, map_, candidate, landmark.position_in_map);
      if (!error || *error > options_.max_error_px) continue;
      map_.AddObservation(id, candidate);
      ++report_.num_new_observations;
    }
  }

  void TryMerge(LandmarkId kept, LandmarkId gone) {
    const Landmark& first = map_.landmark(kept);
    const Landmark& second = map_.landmark(gone);
    const double weight1 = static_cast<double>(first.track.size());
    const double weight2 = static_cast<double>(second.track.size());
    const Eigen::Vector3d mean =
        (weight1 * first.position_in_map + weight2 * second.position_in_map) / (weight1 + weight2);
    const auto fits = [&](const Observation& observation) {
      const auto error = ReprojectionError(camera_, map_, observation, mean);
      return error && *error <= options_.max_error_px;
    };
    if (!std::all_of(first.track.begin(), first.track.end(), fits)) return;
    if (!std::all_of(second.track.begin(), second.track.end(), fits)) return;
    map_.MergeLandmarks(kept, gone);
    map_.MoveLandmark(kept, mean);
    ++report_.num_merged;
  }

  void Triangulate(const PhotoRecords& photos,
                   const Observation& observation,
                   const std::vector<Observation>& candidates) {
    std::vector<Observation> free = {observation};
    for (const Observation& candidate : candidates) {
      if (!map_.LandmarkOf(candidate).IsValid()) free.push_back(candidate);
    }
    if (free.size() < 2) return;
    const auto found = TriangulateCandidates(
        camera_, map_, photos, free, options_.max_error_px, options_.min_parallax_deg * kDegree);
    if (!found) return;
    map_.AddLandmark(found->point_in_map, found->track);
    ++report_.num_new_landmarks;
  }

  const ExpanderOptions& options_;
  const Camera& camera_;
  const MatchGraph& matches_;
  Map& map_;
  std::map<std::pair<PhotoId, PhotoId>, Eigen::Matrix3d> essentials_;
  ExpansionReport report_;
};

}  // namespace

ExpansionReport ExpandMap(const ExpanderOptions& options,
                          const Camera& camera,
                          const MatchGraph& matches,
                          const PhotoRecords& photos,
                          PhotoId photo,
                          Map* map) {
  Expander expander(options, camera, matches, map);
  const auto num_features = static_cast<std::uint32_t>(photos.at(photo).features->size());
  for (std::uint32_t i = 0; i < num_features; ++i) expander.ExpandFeature(photos, {photo, i});
  return expander.report();
}

ExpansionReport CompleteTracks(const ExpanderOptions& options,
                               const Camera& camera,
                               const MatchGraph& matches,
                               const std::vector<LandmarkId>& landmarks,
                               Map* map) {
  Expander expander(options, camera, matches, map);
  for (const LandmarkId id : landmarks) {
    if (map->HasLandmark(id)) expander.CompleteTrack(id);
  }
  return expander.report();
}

int CullLandmarks(const ExpanderOptions& options,
                  const Camera& camera,
                  const std::vector<LandmarkId>& landmarks,
                  Map* map) {
  const std::size_t num_before = map->num_observations();
  for (const LandmarkId id : landmarks) {
    if (!map->HasLandmark(id)) continue;
    const std::vector<Observation> track = map->landmark(id).track;
    for (const Observation& observation : track) {
      if (!map->HasLandmark(id)) break;
      const auto error =
          ReprojectionError(camera, *map, observation, map->landmark(id).position_in_map);
      if (!error || *error > options.max_error_px) map->RemoveObservation(observation);
    }
    if (!map->HasLandmark(id)) continue;
    const Landmark& landmark = map->landmark(id);
    const double parallax = LargestParallax(*map, landmark.track, landmark.position_in_map);
    if (parallax < options.min_parallax_deg * kDegree) map->RemoveLandmark(id);
  }
  return static_cast<int>(num_before - map->num_observations());
}

}  // namespace plumb
