// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How a Map becomes deltas and comes back from a snapshot.
#include <stdexcept>
#include <string>

#include "plumbline/common/check.h"
#include "plumbline/map/map.h"

namespace plumb {

ViewState Map::StateOf(PhotoId photo) const {
  const View& view = this->view(photo);
  return {photo, view.name, view.exposure_time, view.cam_from_map};
}

LandmarkState Map::StateOf(LandmarkId id) const {
  const Landmark& landmark = this->landmark(id);
  return {id, landmark.position_in_map, landmark.color};
}

ObservationState Map::StateOf(const Observation& observation, LandmarkId id) const {
  return {id, observation.photo, observation.feature_idx, PixelOf(observation).cast<float>()};
}

std::optional<MapDelta> Map::TakeDelta() {
  const bool has_changed = has_new_lens_ || !changed_views_.empty() ||
                           !removed_known_views_.empty() || !changed_landmarks_.empty() ||
                           !removed_known_landmarks_.empty() || !added_observations_.empty() ||
                           !removed_observations_.empty();
  if (!has_changed) return std::nullopt;

  MapDelta delta;
  delta.sequence = ++last_sequence_;
  if (has_new_lens_) delta.lens = lens_;
  for (const auto& [key, id] : removed_observations_) {
    const bool goes_with_owner = !HasLandmark(id) || removed_known_views_.count(key.first) != 0;
    if (goes_with_owner) continue;
    delta.observations_removed.push_back(StateOf({key.first, key.second}, id));
  }
  delta.landmarks_removed.assign(removed_known_landmarks_.begin(), removed_known_landmarks_.end());
  delta.views_removed.assign(removed_known_views_.begin(), removed_known_views_.end());
  for (const PhotoId photo : changed_views_) delta.views_set.push_back(StateOf(photo));
  for (const LandmarkId id : changed_landmarks_) delta.landmarks_set.push_back(StateOf(id));
  for (const auto& [key, id] : added_observations_) {
    delta.observations_added.push_back(StateOf({key.first, key.second}, id));
  }
  MarkAllKnown();
  return delta;
}

void Map::MarkAllKnown() {
  has_new_lens_ = false;
  changed_views_.clear();
  removed_known_views_.clear();
  known_views_.clear();
  for (const auto& [photo, view] : views_) known_views_.insert(known_views_.end(), photo);
  changed_landmarks_.clear();
  removed_known_landmarks_.clear();
  num_known_landmark_ids_ = landmarks_.size();
  added_observations_.clear();
  removed_observations_.clear();
}

MapDelta Map::Snapshot() const {
  MapDelta snapshot;
  snapshot.sequence = last_sequence_;
  snapshot.is_snapshot = true;
  snapshot.lens = lens_;
  for (const auto& [photo, view] : views_) snapshot.views_set.push_back(StateOf(photo));
  for (const LandmarkId id : LandmarkIds()) {
    snapshot.landmarks_set.push_back(StateOf(id));
    for (const Observation& observation : landmark(id).track) {
      snapshot.observations_added.push_back(StateOf(observation, id));
    }
  }
  return snapshot;
}

Map Map::SuccessorOf(const Map& other) {
  Map map;
  map.last_sequence_ = other.last_sequence_;
  map.lens_ = other.lens_;
  map.has_new_lens_ = other.has_new_lens_;
  map.landmarks_.resize(other.landmarks_.size());
  map.known_views_ = other.known_views_;
  map.removed_known_views_ = other.known_views_;
  map.num_known_landmark_ids_ = other.num_known_landmark_ids_;
  map.removed_known_landmarks_ = other.removed_known_landmarks_;
  for (const LandmarkId id : other.LandmarkIds()) {
    if (id.value < other.num_known_landmark_ids_) map.removed_known_landmarks_.insert(id);
  }
  return map;
}

Map Map::FromSnapshot(const MapDelta& snapshot,
                      const std::map<PhotoId, std::shared_ptr<const FeatureSet>>& features) {
  const auto refuse = [](const std::string& what) {
    throw std::runtime_error("the stored map contradicts itself: " + what);
  };
  Map map;
  for (const ViewState& state : snapshot.views_set) {
    const auto it = features.find(state.photo);
    if (it == features.end() || !it->second) refuse("view " + state.name + " has no features");
    if (map.HasView(state.photo)) refuse("view " + state.name + " stands twice");
    map.AddView(state.photo,
                {state.name, state.exposure_time, state.cam_from_map, it->second, {}, 0});
  }
  for (const LandmarkState& state : snapshot.landmarks_set) {
    const std::string name = "landmark " + std::to_string(state.id.value);
    if (!state.id.IsValid() || map.HasLandmark(state.id)) refuse(name + " stands twice");
    if (map.landmarks_.size() <= state.id.value) map.landmarks_.resize(state.id.value + 1);
    map.landmarks_[state.id.value] = Landmark{state.position_in_map, state.color, {}};
    ++map.num_landmarks_;
  }
  for (const ObservationState& state : snapshot.observations_added) {
    const std::string name = "observation of landmark " + std::to_string(state.landmark.value);
    if (!map.HasView(state.photo) || !map.HasLandmark(state.landmark)) refuse(name + " is loose");
    const Observation observation{state.photo, state.feature_idx};
    if (state.feature_idx >= map.view(state.photo).features->size()) {
      refuse(name + " is of a feature that does not exist");
    }
    if (map.LandmarkOf(observation).IsValid()) refuse(name + " stands twice");
    map.Attach(state.landmark, observation);
  }
  for (const LandmarkId id : map.LandmarkIds()) {
    if (map.landmark(id).track.size() < 2) {
      refuse("landmark " + std::to_string(id.value) + " has fewer than two observations");
    }
  }
  map.lens_ = snapshot.lens;
  map.last_sequence_ = snapshot.sequence;
  map.MarkAllKnown();
  return map;
}

}  // namespace plumb
