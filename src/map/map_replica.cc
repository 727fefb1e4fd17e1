// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/map_replica.h"

#include <algorithm>
#include <set>
#include <vector>

namespace plumb {

bool MapReplica::Apply(const MapDelta& delta) {
  if (delta.is_snapshot) {
    Clear();
  } else if (delta.sequence != sequence_ + 1) {
    return false;
  }
  Remove(delta);
  Set(delta);
  sequence_ = delta.sequence;
  return true;
}

MapDelta MapReplica::Snapshot() const {
  MapDelta snapshot;
  snapshot.sequence = sequence_;
  snapshot.is_snapshot = true;
  snapshot.lens = lens_;
  for (const auto& [photo, view] : views_) snapshot.views_set.push_back(view);
  std::vector<LandmarkId> ids;
  ids.reserve(landmarks_.size());
  for (const auto& [id, landmark] : landmarks_) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  for (const LandmarkId id : ids) {
    const TrackedLandmark& landmark = landmarks_.at(id);
    snapshot.landmarks_set.push_back(landmark.state);
    for (const auto& [feature, pixel] : landmark.pixel_of_feature) {
      snapshot.observations_added.push_back({id, feature.first, feature.second, pixel});
    }
  }
  return snapshot;
}

void MapReplica::Clear() { *this = MapReplica(); }

void MapReplica::Remove(const MapDelta& delta) {
  for (const ObservationState& observation : delta.observations_removed) {
    const auto it = landmarks_.find(observation.landmark);
    if (it == landmarks_.end()) continue;
    it->second.pixel_of_feature.erase({observation.photo, observation.feature_idx});
  }
  for (const LandmarkId id : delta.landmarks_removed) landmarks_.erase(id);
  if (delta.views_removed.empty()) return;
  const std::set<PhotoId> gone(delta.views_removed.begin(), delta.views_removed.end());
  for (const PhotoId photo : gone) views_.erase(photo);
  for (auto& [id, landmark] : landmarks_) {
    auto& pixels = landmark.pixel_of_feature;
    for (auto it = pixels.begin(); it != pixels.end();) {
      it = gone.count(it->first.first) != 0 ? pixels.erase(it) : std::next(it);
    }
  }
}

void MapReplica::Set(const MapDelta& delta) {
  if (delta.lens) lens_ = delta.lens;
  for (const ViewState& view : delta.views_set) views_[view.photo] = view;
  for (const LandmarkState& landmark : delta.landmarks_set) {
    landmarks_[landmark.id].state = landmark;
  }
  for (const ObservationState& observation : delta.observations_added) {
    const auto it = landmarks_.find(observation.landmark);
    if (it == landmarks_.end()) continue;
    it->second.pixel_of_feature[{observation.photo, observation.feature_idx}] = observation.pixel;
  }
}

}  // namespace plumb
