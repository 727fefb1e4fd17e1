// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/map.h"

#include <algorithm>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

Rgb MeanColor(const std::map<PhotoId, View>& views, const std::vector<Observation>& track) {
  std::array<int, 3> sum = {0, 0, 0};
  for (const Observation& observation : track) {
    const Rgb& color = views.at(observation.photo).features->colors[observation.feature_idx];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += color[i];
  }
  Rgb mean = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    mean[i] = static_cast<std::uint8_t>(sum[i] / static_cast<int>(track.size()));
  }
  return mean;
}

}  // namespace

const View& Map::view(PhotoId photo) const {
  const auto it = views_.find(photo);
  PLUMB_CHECK(it != views_.end());
  return it->second;
}

View& Map::MutableView(PhotoId photo) { return const_cast<View&>(view(photo)); }

std::vector<LandmarkId> Map::LandmarkIds() const {
  std::vector<LandmarkId> ids;
  ids.reserve(num_landmarks_);
  for (std::uint32_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i]) ids.push_back(LandmarkId{i});
  }
  return ids;
}

bool Map::HasLandmark(LandmarkId id) const {
  return id.value < landmarks_.size() && landmarks_[id.value].has_value();
}

const Landmark& Map::landmark(LandmarkId id) const {
  PLUMB_CHECK(HasLandmark(id));
  return *landmarks_[id.value];
}

Landmark& Map::MutableLandmark(LandmarkId id) { return const_cast<Landmark&>(landmark(id)); }

Eigen::Vector2d Map::PixelOf(const Observation& observation) const {
  return view(observation.photo).features->features[observation.feature_idx].Pixel();
}

LandmarkId Map::LandmarkOf(const Observation& observation) const {
  return view(observation.photo).landmark_of_feature[observation.feature_idx];
}

void Map::AddView(PhotoId photo, View view) {
  PLUMB_CHECK(!HasView(photo));
  PLUMB_CHECK(view.features != nullptr);
  view.landmark_of_feature.assign(view.features->size(), LandmarkId{});
  view.num_observations = 0;
  views_.emplace(photo, std::move(view));
  changed_views_.insert(photo);
}

void Map::MoveView(PhotoId photo, const Rigid3& cam_from_map) {
  MutableView(photo).cam_from_map = cam_from_map;
  changed_views_.insert(photo);
}

void Map::RemoveView(PhotoId photo) {
  const std::size_t num_features = view(photo).landmark_of_feature.size();
  for (std::uint32_t i = 0; i < num_features; ++i) {
    if (view(photo).landmark_of_feature[i].IsValid()) RemoveObservation({photo, i});
  }
  views_.erase(photo);
  changed_views_.erase(photo);
  if (known_views_.count(photo) != 0) removed_known_views_.insert(photo);
}

LandmarkId Map::AddLandmark(const Eigen::Vector3d& position_in_map,
                            const std::vector<Observation>& track) {
  PLUMB_CHECK_GE(track.size(), 2U);
  const LandmarkId id{static_cast<std::uint32_t>(landmarks_.size())};
  landmarks_.push_back(Landmark{position_in_map, MeanColor(views_, track), {}});
  ++num_landmarks_;
  changed_landmarks_.insert(id);
  for (const Observation& observation : track) AddObservation(id, observation);
  return id;
}

void Map::MoveLandmark(LandmarkId id, const Eigen::Vector3d& position_in_map) {
  MutableLandmark(id).position_in_map = position_in_map;
  changed_landmarks_.insert(id);
}

void Map::RemoveLandmark(LandmarkId id) {
  const std::vector<Observation> track = landmark(id).track;
  for (const Observation& observation : track) Detach(id, observation);
  landmarks_[id.value].reset();
  --num_landmarks_;
  changed_landmarks_.erase(id);
  if (id.value < num_known_landmark_ids_) removed_known_landmarks_.insert(id);
}

void Map::AddObservation(LandmarkId id, const Observation& observation) {
  PLUMB_CHECK_LT(observation.feature_idx, view(observation.photo).landmark_of_feature.size());
  PLUMB_CHECK(!LandmarkOf(observation).IsValid());
  for (const Observation& other : landmark(id).track) {
    PLUMB_CHECK(other.photo != observation.photo);
  }
  Attach(id, observation);
}

void Map::RemoveObservation(Observation observation) {
  const LandmarkId id = LandmarkOf(observation);
  PLUMB_CHECK(id.IsValid());
  if (landmark(id).track.size() <= 2) {
    RemoveLandmark(id);
  } else {
    Detach(id, observation);
  }
}

void Map::MergeLandmarks(LandmarkId kept, LandmarkId gone) {
  PLUMB_CHECK(kept != gone);
  const std::vector<Observation> moved = landmark(gone).track;
  RemoveLandmark(gone);
  for (const Observation& observation : moved) {
    const std::vector<Observation>& track = landmark(kept).track;
    const bool is_seen = std::any_of(track.begin(), track.end(), [&](const Observation& other) {
      return other.photo == observation.photo;
    });
    if (!is_seen) Attach(kept, observation);
  }
}

void Map::SetLens(const LensParameters<double>& lens) {
  lens_ = lens;
  has_new_lens_ = true;
}

void Map::Attach(LandmarkId id, const Observation& observation) {
  View& view = MutableView(observation.photo);
  view.landmark_of_feature[observation.feature_idx] = id;
  ++view.num_observations;
  ++num_observations_;
  MutableLandmark(id).track.push_back(observation);

  const ObservationKey key{observation.photo, observation.feature_idx};
  const auto removed = removed_observations_.find(key);
  const bool is_back = removed != removed_observations_.end() && removed->second == id &&
                       removed_known_views_.count(observation.photo) == 0;
  if (is_back) {
    removed_observations_.erase(removed);
  } else {
    added_observations_[key] = id;
  }
}

void Map::Detach(LandmarkId id, Observation observation) {
  View& view = MutableView(observation.photo);
  view.landmark_of_feature[observation.feature_idx] = LandmarkId{};
  --view.num_observations;
  --num_observations_;
  std::vector<Observation>& track = MutableLandmark(id).track;
  track.erase(std::find(track.begin(), track.end(), observation));

  const ObservationKey key{observation.photo, observation.feature_idx};
  if (added_observations_.erase(key) == 0) removed_observations_[key] = id;
}

}  // namespace plumb
