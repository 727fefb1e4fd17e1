// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/map_conversion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

template <typename Ids>
std::vector<std::uint32_t> ToNumbers(const Ids& ids) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(ids.size());
  for (const auto id : ids) numbers.push_back(id.value);
  return numbers;
}

template <typename Id>
std::vector<Id> ToIds(const std::vector<std::uint32_t>& numbers) {
  std::vector<Id> ids;
  ids.reserve(numbers.size());
  for (const std::uint32_t number : numbers) ids.push_back(Id{number});
  return ids;
}

template <typename Values>
bool AreFinite(const Values& values) {
  return std::all_of(values.begin(), values.end(), [](auto value) { return std::isfinite(value); });
}

plumbline::ViewState ToViewMsg(const ViewState& view) {
  plumbline::ViewState msg;
  msg.photo = view.photo.value;
  msg.name = view.name;
  msg.exposure_time = ToRosTime(view.exposure_time);
  msg.cam_from_map = ToTransformMsg(view.cam_from_map);
  return msg;
}

plumbline::LandmarkStates ToLandmarksMsg(const std::vector<LandmarkState>& landmarks) {
  plumbline::LandmarkStates msg;
  msg.ids.reserve(landmarks.size());
  msg.positions_in_map.reserve(3 * landmarks.size());
  msg.colors_rgb.reserve(3 * landmarks.size());
  for (const LandmarkState& landmark : landmarks) {
    msg.ids.push_back(landmark.id.value);
    const double* position = landmark.position_in_map.data();
    msg.positions_in_map.insert(msg.positions_in_map.end(), position, position + 3);
    msg.colors_rgb.insert(msg.colors_rgb.end(), landmark.color.begin(), landmark.color.end());
  }
  return msg;
}

// Removed observations are named; where their pixels were is of no use.
plumbline::ObservationStates ToObservationsMsg(const std::vector<ObservationState>& observations,
                                               bool with_pixels) {
  plumbline::ObservationStates msg;
  for (const ObservationState& observation : observations) {
    msg.landmarks.push_back(observation.landmark.value);
    msg.photos.push_back(observation.photo.value);
    msg.feature_idxs.push_back(observation.feature_idx);
    if (!with_pixels) continue;
    msg.pixels_px.push_back(observation.pixel.x());
    msg.pixels_px.push_back(observation.pixel.y());
  }
  return msg;
}

bool AppendViews(const std::vector<plumbline::ViewState>& msgs, std::vector<ViewState>* views) {
  for (const plumbline::ViewState& msg : msgs) {
    const std::optional<Rigid3> cam_from_map = FromTransformMsg(msg.cam_from_map);
    if (!cam_from_map) return false;
    views->push_back({PhotoId{msg.photo}, msg.name, FromRosTime(msg.exposure_time), *cam_from_map});
  }
  return true;
}

bool AppendLandmarks(const plumbline::LandmarkStates& msg, std::vector<LandmarkState>* landmarks) {
  const std::size_t num = msg.ids.size();
  if (msg.positions_in_map.size() != 3 * num || msg.colors_rgb.size() != 3 * num) return false;
  if (!AreFinite(msg.positions_in_map)) return false;
  for (std::size_t i = 0; i < num; ++i) {
    const double* position = &msg.positions_in_map[3 * i];
    const std::uint8_t* color = &msg.colors_rgb[3 * i];
    landmarks->push_back({LandmarkId{msg.ids[i]},
                          {position[0], position[1], position[2]},
                          {color[0], color[1], color[2]}});
  }
  return true;
}

bool AppendObservations(const plumbline::ObservationStates& msg,
                        bool with_pixels,
                        std::vector<ObservationState>* observations) {
  const std::size_t num = msg.landmarks.size();
  if (msg.photos.size() != num || msg.feature_idxs.size() != num) return false;
  if (msg.pixels_px.size() != (with_pixels ? 2 * num : 0)) return false;
  if (!AreFinite(msg.pixels_px)) return false;
  for (std::size_t i = 0; i < num; ++i) {
    ObservationState observation;
    observation.landmark = LandmarkId{msg.landmarks[i]};
    observation.photo = PhotoId{msg.photos[i]};
    observation.feature_idx = msg.feature_idxs[i];
    if (with_pixels) observation.pixel = {msg.pixels_px[2 * i], msg.pixels_px[2 * i + 1]};
    observations->push_back(observation);
  }
  return true;
}

}  // namespace

plumbline::MapDelta ToMapDeltaMsg(const MapDelta& delta,
                                  const std::string& map_frame_id,
                                  const ros::Time& stamp) {
  plumbline::MapDelta msg;
  msg.header.frame_id = map_frame_id;
  msg.header.stamp = stamp;
  msg.sequence = delta.sequence;
  msg.is_snapshot = static_cast<std::uint8_t>(delta.is_snapshot);
  if (delta.lens) msg.lens.assign(delta.lens->begin(), delta.lens->end());
  msg.observations_removed = ToObservationsMsg(delta.observations_removed, /*with_pixels=*/false);
  msg.landmarks_removed = ToNumbers(delta.landmarks_removed);
  msg.views_removed = ToNumbers(delta.views_removed);
  for (const ViewState& view : delta.views_set) msg.views_set.push_back(ToViewMsg(view));
  msg.landmarks_set = ToLandmarksMsg(delta.landmarks_set);
  msg.observations_added = ToObservationsMsg(delta.observations_added, /*with_pixels=*/true);
  return msg;
}

std::optional<MapDelta> FromMapDeltaMsg(const plumbline::MapDelta& msg) {
  MapDelta delta;
  delta.sequence = msg.sequence;
  delta.is_snapshot = msg.is_snapshot != 0;
  if (!msg.lens.empty()) {
    if (msg.lens.size() != kNumLensParameters || !AreFinite(msg.lens)) return std::nullopt;
    std::copy(msg.lens.begin(), msg.lens.end(), delta.lens.emplace().begin());
  }
  delta.landmarks_removed = ToIds<LandmarkId>(msg.landmarks_removed);
  delta.views_removed = ToIds<PhotoId>(msg.views_removed);
  const bool is_sound = AppendObservations(msg.observations_removed,
                                           /*with_pixels=*/false,
                                           &delta.observations_removed) &&
                        AppendViews(msg.views_set, &delta.views_set) &&
                        AppendLandmarks(msg.landmarks_set, &delta.landmarks_set) &&
                        AppendObservations(msg.observations_added,
                                           /*with_pixels=*/true,
                                           &delta.observations_added);
  if (!is_sound) return std::nullopt;
  return delta;
}

}  // namespace plumb::ros_adapter
