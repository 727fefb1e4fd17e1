// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "plumbline/map/map_delta.h"
#include "plumbline/map/map_replica.h"
#include "test/support/random.h"

namespace plumb::test {

// A wall with relief before which cameras hover, and deltas that change it at random.
class RandomMap {
 public:
  struct Options {
    int num_landmarks = 30;  // About; they come and go.
    int num_views = 6;
    int num_changes = 3;  // A delta.
    int seed = 1;
  };

  explicit RandomMap(const Options& options) : options_(options), random_(options.seed) {
    delta_ = {};
    for (int i = 0; i < options.num_views; ++i) AddView();
    for (int i = 0; i < options.num_landmarks; ++i) AddLandmark();
    Finish();
  }

  // The last change; the first one makes the map.
  const MapDelta& delta() const { return delta_; }
  const MapReplica& replica() const { return replica_; }

  void Change() {
    delta_ = {};
    const int num_changes = 1 + random_.Index(options_.num_changes);
    for (int i = 0; i < num_changes; ++i) ChangeOne();
    Finish();
  }

 private:
  struct Track {
    Eigen::Vector3d position;
    std::set<std::uint32_t> views;
  };

  void Finish() {
    delta_.sequence = replica_.sequence() + 1;
    replica_.Apply(delta_);
  }

  void ChangeOne() {
    const int num = static_cast<int>(tracks_.size());
    switch (random_.Index(8)) {
      case 0:
        if (num < 2 * options_.num_landmarks) AddLandmark();
        break;
      case 1:
        if (num > options_.num_landmarks / 2) RemoveLandmark();
        break;
      case 2:
      case 3:
        MoveLandmark(random_.Index(2) == 0 ? 0.002 : 0.2);
        break;
      case 4:
        MoveView(random_.Index(2) == 0 ? 0.005 : 0.3);
        break;
      case 5:
      case 6:
        ChangeRay();
        break;
      default:
        if (random_.Index(10) != 0) break;
        RemoveView();
        AddView();
    }
  }

  Eigen::Vector3d AnyPoint() {
    return {random_.Uniform(-3, 3), random_.Uniform(-0.1, 0.1), random_.Uniform(-2, 2)};
  }

  void AddView() {
    const Eigen::Vector3d center(
        random_.Uniform(-4, 4), random_.Uniform(-6, -3), random_.Uniform(-2, 2));
    views_[next_view_] = center;
    SetView(next_view_++);
  }

  void SetView(std::uint32_t id) {
    ViewState state;
    state.photo = PhotoId{id};
    state.cam_from_map = Rigid3(Eigen::Quaterniond::Identity(), -views_.at(id));
    delta_.views_set.push_back(state);
  }

  void RemoveView() {
    const std::uint32_t gone = AnyView();
    if (std::any_of(delta_.views_set.begin(), delta_.views_set.end(), [&](const ViewState& view) {
          return view.photo.value == gone;
        })) {
      return;
    }
    // Observations that this delta adds would come after the removal.
    for (const ObservationState& added : delta_.observations_added) {
      if (added.photo.value == gone) return;
    }
    views_.erase(gone);
    for (auto& [id, track] : tracks_) track.views.erase(gone);
    delta_.views_removed.push_back(PhotoId{gone});
  }

  void MoveView(double distance_m) {
    const std::uint32_t id = AnyView();
    views_.at(id) += random_.InBox(distance_m);
    SetView(id);
  }

  void AddLandmark() {
    tracks_[next_landmark_].position = AnyPoint();
    SetLandmark(next_landmark_);
    for (int i = 0; i < 3; ++i) AddRay(next_landmark_, AnyView());
    ++next_landmark_;
  }

  void SetLandmark(std::uint32_t id) {
    delta_.landmarks_set.push_back({LandmarkId{id}, tracks_.at(id).position, {1, 2, 3}});
  }

  bool IsNew(std::uint32_t landmark) const {
    return std::any_of(delta_.landmarks_set.begin(),
                       delta_.landmarks_set.end(),
                       [&](const LandmarkState& state) { return state.id.value == landmark; });
  }

  void RemoveLandmark() {
    const std::uint32_t id = AnyLandmark();
    if (IsNew(id)) return;
    for (const ObservationState& added : delta_.observations_added) {
      if (added.landmark.value == id) return;
    }
    tracks_.erase(id);
    delta_.landmarks_removed.push_back(LandmarkId{id});
  }

  void MoveLandmark(double distance_m) {
    const std::uint32_t id = AnyLandmark();
    tracks_.at(id).position += random_.InBox(distance_m);
    SetLandmark(id);
  }

  void AddRay(std::uint32_t landmark, std::uint32_t view) {
    if (!tracks_.at(landmark).views.insert(view).second) return;
    delta_.observations_added.push_back({LandmarkId{landmark}, PhotoId{view}, landmark, {0, 0}});
  }

  void ChangeRay() {
    const std::uint32_t landmark = AnyLandmark();
    const std::uint32_t view = AnyView();
    if (tracks_.at(landmark).views.count(view) == 0) {
      AddRay(landmark, view);
      return;
    }
    for (const ObservationState& added : delta_.observations_added) {
      if (added.landmark.value == landmark) return;
    }
    tracks_.at(landmark).views.erase(view);
    delta_.observations_removed.push_back({LandmarkId{landmark}, PhotoId{view}, landmark, {0, 0}});
  }

  std::uint32_t AnyLandmark() {
    auto it = tracks_.begin();
    std::advance(it, random_.Index(static_cast<int>(tracks_.size())));
    return it->first;
  }
  std::uint32_t AnyView() {
    auto it = views_.begin();
    std::advance(it, random_.Index(static_cast<int>(views_.size())));
    return it->first;
  }

  Options options_;
  Random random_;
  MapDelta delta_;
  MapReplica replica_;
  std::map<std::uint32_t, Eigen::Vector3d> views_;
  std::map<std::uint32_t, Track> tracks_;
  std::uint32_t next_view_ = 0;
  std::uint32_t next_landmark_ = 0;
};

}  // namespace plumb::test
