// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/image/features.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

struct Observation {
  PhotoId photo;
  std::uint32_t feature_idx = 0;

  friend bool operator==(const Observation& a, const Observation& b) {
    return a.photo == b.photo && a.feature_idx == b.feature_idx;
  }
};

// A point of the facade, with the features that show it: at most one a view.
struct Landmark {
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  Rgb color = {0, 0, 0};
  std::vector<Observation> track;
};

// A located photo.
struct View {
  std::string name;
  Timestamp exposure_time;
  Rigid3 cam_from_map;
  std::shared_ptr<const FeatureSet> features;
  std::vector<LandmarkId>
      landmark_of_feature;  // As long as the features; invalid where there is none.
  int num_observations = 0;
};

// Views, landmarks and the observations that tie them: data and its invariants,
// no algorithm. Every change is recorded for TakeDelta. Copies are independent
// but share the features. Not thread-safe.
class Map {
 public:
  const std::map<PhotoId, View>& views() const { return views_; }
  bool HasView(PhotoId photo) const { return views_.count(photo) != 0; }
  const View& view(PhotoId photo) const;

  // Iterates in the order of ids: for (LandmarkId id : map.LandmarkIds()).
  std::vector<LandmarkId> LandmarkIds() const;
  bool HasLandmark(LandmarkId id) const;
  const Landmark& landmark(LandmarkId id) const;
  std::size_t num_landmarks() const { return num_landmarks_; }
  std::size_t num_observations() const { return num_observations_; }

  Eigen::Vector2d PixelOf(const Observation& observation) const;
  LandmarkId LandmarkOf(const Observation& observation) const;

  void AddView(PhotoId photo, View view);  // Its landmark_of_feature is reset.
  void MoveView(PhotoId photo, const Rigid3& cam_from_map);
  void RemoveView(PhotoId photo);  // Landmarks left with fewer than two observations go too.

  LandmarkId AddLandmark(const Eigen::Vector3d& position_in_map,
                         const std::vector<Observation>& track);
  void MoveLandmark(LandmarkId id, const Eigen::Vector3d& position_in_map);
  void RemoveLandmark(LandmarkId id);

  // The feature must be free and the landmark not yet seen in that view.
  void AddObservation(LandmarkId id, const Observation& observation);
  // The landmark goes too if fewer than two observations are left. By value: the argument may
  // be an element of the track that shrinks.
  void RemoveObservation(Observation observation);
  // Moves the observations of `gone` to `kept`; where both are seen in one view, kept's stays.
  void MergeLandmarks(LandmarkId kept, LandmarkId gone);

  // Records that the shared lens was refined.
  void SetLens(const LensParameters<double>& lens);

  // All changes since the last call, numbered; nothing if there were none.
  std::optional<MapDelta> TakeDelta();

  // The whole map as one delta, under the number of the last one taken.
  MapDelta Snapshot() const;

  // An empty map that goes on numbering deltas and ids after `other`'s, records the removal of
  // everything in it and keeps its lens.
  static Map SuccessorOf(const Map& other);

  // Rebuilds a map from a snapshot; `features` holds those of each of its views. Throws
  // std::runtime_error naming what contradicts itself.
  static Map FromSnapshot(const MapDelta& snapshot,
                          const std::map<PhotoId, std::shared_ptr<const FeatureSet>>& features);

 private:
  using ObservationKey = std::pair<PhotoId, std::uint32_t>;

  View& MutableView(PhotoId photo);
  Landmark& MutableLandmark(LandmarkId id);
  ViewState StateOf(PhotoId photo) const;
  LandmarkState StateOf(LandmarkId id) const;
  ObservationState StateOf(const Observation& observation, LandmarkId id) const;
  void Attach(LandmarkId id, const Observation& observation);
  void Detach(LandmarkId id, Observation observation);
  void MarkAllKnown();

  std::map<PhotoId, View> views_;
  std::vector<std::optional<Landmark>> landmarks_;  // By id; empty where removed.
  std::size_t num_landmarks_ = 0;
  std::size_t num_observations_ = 0;
  std::optional<LensParameters<double>> lens_;  // If it was refined.

  // Changes since the last delta. "Known" ids are those the last delta left behind.
  std::uint32_t last_sequence_ = 0;
  bool has_new_lens_ = false;
  std::set<PhotoId> changed_views_;
  std::set<PhotoId> removed_known_views_;
  std::set<PhotoId> known_views_;
  std::set<LandmarkId> changed_landmarks_;
  std::set<LandmarkId> removed_known_landmarks_;
  std::size_t num_known_landmark_ids_ = 0;
  std::map<ObservationKey, LandmarkId> added_observations_;
  std::map<ObservationKey, LandmarkId> removed_observations_;
};

}  // namespace plumb
