// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bundle_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "common/median.h"
#include "plumbline/geometry/similarity3.h"
#include "sfm/covisibility.h"

namespace plumb {
namespace {

// SIFT gives a spot one feature for each of its dominant orientations, next to each other.
int NumOrientations(const FeatureSet& features, std::uint32_t first_idx) {
  const Feature& first = features.features[first_idx];
  int number = 1;
  for (std::size_t i = first_idx + 1; i < features.size(); ++i) {
    const Feature& other = features.features[i];
    if (other.scale_px != first.scale_px) break;
    number += other.x_px == first.x_px && other.y_px == first.y_px ? 1 : 0;
  }
  return number;
}

// A SIFT feature is as uncertain as it is large (Lowe, IJCV 2004: position is refined to a
// fraction of the scale): one of the finest features of the photo weighs 1. A spot of several
// orientations is a corner more often than an edge, and weighs as so many features: the mean error
// over eight orders of Herz-Jesus-P8 is 3.30 mm instead of 3.36 mm, of fountain-P11 2.27 mm instead
// of 2.25 mm.
double WeightOf(const FeatureSet& features, std::uint32_t feature_idx) {
  const double scale_ratio =
      features.features.back().scale_px / features.features[feature_idx].scale_px;
  return scale_ratio * std::sqrt(NumOrientations(features, feature_idx));
}

// Copies views and landmarks of a map into a problem, each once.
class ProblemBuilder {
 public:
  // Observations of a photo count `influence` times as much; 1 where it is not told.
  ProblemBuilder(const Map& map,
                 const LensParameters<double>& lens,
                 std::map<PhotoId, double> influences = {})
      : map_(map), influences_(std::move(influences)) {
    problem_.lens = lens;
  }

  void AddView(PhotoId photo, bool is_fixed) { ViewIndex(photo, is_fixed); }

  // All observations of the landmark; views not added before come in fixed. Points behind a
  // camera are left out of it: the cost has no value there.
  void AddLandmark(LandmarkId id) {
    const Landmark& landmark = map_.landmark(id);
    const auto landmark_idx = static_cast<std::uint32_t>(problem_.landmarks.size());
    problem_.landmarks.push_back({id, landmark.position_in_map});
    for (const Observation& observation : landmark.track) {
      const View& view = map_.view(observation.photo);
      if ((view.cam_from_map * landmark.position_in_map).z() <= 0.0) continue;
      problem_.observations.push_back(
          {ViewIndex(observation.photo, /*is_fixed=*/true),
           landmark_idx,
           map_.PixelOf(observation),
           InfluenceOf(observation.photo) * WeightOf(*view.features, observation.feature_idx)});
    }
  }

  void AddMarker(const MarkerTrack& track) {
    const auto marker_idx = static_cast<std::uint32_t>(problem_.markers.size());
    std::vector<BundleSighting> sightings;
    for (const MarkerSighting& sighting : track.sightings) {
      if (!IsBeforeCamera(sighting.photo, track.position_in_map)) continue;
      sightings.push_back({ViewIndex(sighting.photo, /*is_fixed=*/true),
                           marker_idx,
                           sighting.center_px,
                           sighting.sigma_px});
    }
    if (sightings.empty() || (sightings.size() < 2 && !track.survey)) return;
    problem_.markers.push_back({track.marker_id, track.position_in_map, track.survey});
    problem_.sightings.insert(problem_.sightings.end(), sightings.begin(), sightings.end());
  }

  void AddCenter(const CenterPrior& prior) {
    if (!map_.HasView(prior.photo)) return;
    problem_.centers.push_back({ViewIndex(prior.photo, /*is_fixed=*/true), prior.center});
  }

  BundleProblem Take() { return std::move(problem_); }

 private:
  bool IsBeforeCamera(PhotoId photo, const Eigen::Vector3d& position_in_map) const {
    return map_.HasView(photo) && (map_.view(photo).cam_from_map * position_in_map).z() > 0.0;
  }

  double InfluenceOf(PhotoId photo) const {
    const auto influence = influences_.find(photo);
    return influence == influences_.end() ? 1.0 : influence->second;
  }

  std::uint32_t ViewIndex(PhotoId photo, bool is_fixed) {
    const auto next = static_cast<std::uint32_t>(problem_.views.size());
    const auto [it, is_new] = view_indices_.try_emplace(photo, next);
    if (is_new) problem_.views.push_back({photo, map_.view(photo).cam_from_map, is_fixed});
    return it->second;
  }

  const Map& map_;
  std::map<PhotoId, double> influences_;
  BundleProblem problem_;
  std::unordered_map<PhotoId, std::uint32_t> view_indices_;
};

// Median depth of the landmarks of each view that has any.
std::map<PhotoId, double> SceneDistances(const Map& map) {
  std::map<PhotoId, double> distances;
  for (const auto& [photo, view] : map.views()) {
    std::vector<double> depths;
    for (const LandmarkId id : view.landmark_of_feature) {
      if (!id.IsValid()) continue;
      const double depth = (view.cam_from_map * map.landmark(id).position_in_map).z();
      if (depth > 0.0) depths.push_back(depth);
    }
    if (!depths.empty()) distances[photo] = MedianOf(std::move(depths));
  }
  return distances;
}

// The multi-scale term, docs/bundle.md.
std::map<PhotoId, double> InfluencesByDistance(const Map& map, double exponent) {
  if (exponent == 0.0) return {};
  std::map<PhotoId, double> influences = SceneDistances(map);
  if (influences.empty()) return {};
  std::vector<double> distances;
  for (const auto& [photo, distance] : influences) distances.push_back(distance);
  const double median = MedianOf(std::move(distances));
  for (auto& [photo, influence] : influences) influence = std::pow(influence / median, exponent);
  return influences;
}

Similarity3 MotionOf(const BundleView& before, const BundleView& after) {
  const Rigid3 motion = after.cam_from_map.Inverse() * before.cam_from_map;
  return {1.0, motion.rotation, motion.translation};
}

using Motions = std::map<PhotoId, Similarity3>;  // map_from_map of each view's surroundings.

// Of the views that were solved; a later one takes the motion of the view it shares most with,
// also where that is itself a later one.
Motions MotionsOfViews(const BundleProblem& before, const BundleProblem& after, const Map& map) {
  Motions motions;
  for (std::size_t i = 0; i < before.views.size(); ++i) {
    if (!map.HasView(before.views[i].photo)) continue;
    motions[before.views[i].photo] = MotionOf(before.views[i], after.views[i]);
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [photo, view] : map.views()) {
      if (motions.count(photo) != 0) continue;
      for (const CovisibleView& other : CovisibleViews(map, photo)) {
        const auto motion = motions.find(other.photo);
        if (motion == motions.end()) continue;
        motions[photo] = motion->second;
        grows = true;
        break;
      }
    }
  }
  return motions;
}

}  // namespace

BundleProblem MakeGlobalBundle(const BundleOptions& options,
                               const Map& map,
                               const LensParameters<double>& lens,
                               const BundleConstraints& constraints) {
  ProblemBuilder builder(map, lens, InfluencesByDistance(map, options.distance_exponent));
  for (const auto& [photo, view] : map.views()) builder.AddView(photo, /*is_fixed=*/false);
  for (const LandmarkId id : map.LandmarkIds()) builder.AddLandmark(id);
  for (const MarkerTrack& marker : constraints.markers) builder.AddMarker(marker);
  for (const CenterPrior& center : constraints.centers) builder.AddCenter(center);
  return builder.Take();
}

BundleProblem MakeLocalBundle(const BundleOptions& options,
                              const Map& map,
                              const LensParameters<double>& lens,
                              PhotoId photo) {
  ProblemBuilder builder(map, lens);
  std::vector<PhotoId> free_views = {photo};
  for (const CovisibleView& other : CovisibleViews(map, photo)) {
    if (static_cast<int>(free_views.size()) > options.num_local_views) break;
    free_views.push_back(other.photo);
  }
  // Something must hold the gauge where the surroundings are the whole map.
  const bool is_whole_map = free_views.size() == map.views().size();
  const PhotoId oldest = *std::min_element(free_views.begin(), free_views.end());
  for (const PhotoId free_view : free_views) {
    builder.AddView(free_view, is_whole_map && free_view == oldest);
  }
  for (const LandmarkId id : LongestTracks(map, free_views, options.max_local_landmarks)) {
    builder.AddLandmark(id);
  }
  return builder.Take();
}

void ApplyBundle(const BundleProblem& problem, Map* map) {
  for (const BundleView& view : problem.views) {
    if (!view.is_fixed) map->MoveView(view.photo, view.cam_from_map);
  }
  for (const BundleLandmark& landmark : problem.landmarks) {
    map->MoveLandmark(landmark.id, landmark.position_in_map);
  }
}

void ApplyStaleBundle(const BundleProblem& before, const BundleProblem& after, Map* map) {
  const Motions motions = MotionsOfViews(before, after, *map);
  std::vector<std::optional<Eigen::Vector3d>> solved;
  for (const BundleLandmark& landmark : after.landmarks) {
    if (solved.size() <= landmark.id.value) solved.resize(landmark.id.value + 1);
    solved[landmark.id.value] = landmark.position_in_map;
  }
  for (const LandmarkId id : map->LandmarkIds()) {
    if (id.value < solved.size() && solved[id.value]) {
      map->MoveLandmark(id, *solved[id.value]);
      continue;
    }
    for (const Observation& observation : map->landmark(id).track) {
      const auto motion = motions.find(observation.photo);
      if (motion == motions.end()) continue;
      map->MoveLandmark(id, motion->second * map->landmark(id).position_in_map);
      break;
    }
  }
  for (const auto& [photo, motion] : motions) {
    map->MoveView(photo, TransformCamera(motion, map->view(photo).cam_from_map));
  }
}

}  // namespace plumb
