// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/constraints_conversion.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumb::ros_adapter {
namespace {

template <typename Array>
void ToArray(const Eigen::Vector3d& vector, Array* array) {
  std::copy(vector.data(), vector.data() + 3, array->begin());
}

bool IsSigma(double value) { return std::isfinite(value) && value > 0.0; }

plumbline::ControlPoint ToControlPointMsg(const MarkerTrack& track) {
  plumbline::ControlPoint msg;
  msg.marker_id = track.marker_id;
  ToArray(track.position_in_map, &msg.position_in_map);
  msg.is_surveyed = static_cast<std::uint8_t>(track.survey.has_value());
  if (track.survey) {
    ToArray(track.survey->position_in_map, &msg.survey_in_map);
    msg.survey_sigma = track.survey->sigma;
  }
  for (const MarkerSighting& sighting : track.sightings) {
    msg.photos.push_back(sighting.photo.value);
    msg.centers_px.push_back(sighting.center_px.x());
    msg.centers_px.push_back(sighting.center_px.y());
    msg.sigmas_px.push_back(sighting.sigma_px);
  }
  return msg;
}

bool AppendSightings(const plumbline::ControlPoint& msg, std::vector<MarkerSighting>* sightings) {
  const std::size_t num = msg.photos.size();
  if (msg.centers_px.size() != 2 * num || msg.sigmas_px.size() != num) return false;
  std::set<std::uint32_t> photos;
  for (std::size_t i = 0; i < num; ++i) {
    MarkerSighting sighting;
    sighting.photo = PhotoId{msg.photos[i]};
    sighting.center_px = {msg.centers_px[2 * i], msg.centers_px[2 * i + 1]};
    sighting.sigma_px = msg.sigmas_px[i];
    const bool is_sound = sighting.photo.IsValid() && photos.insert(msg.photos[i]).second &&
                          sighting.center_px.allFinite() && IsSigma(sighting.sigma_px);
    if (!is_sound) return false;
    sightings->push_back(sighting);
  }
  return true;
}

std::optional<MarkerTrack> FromControlPointMsg(const plumbline::ControlPoint& msg) {
  MarkerTrack track;
  track.marker_id = msg.marker_id;
  track.position_in_map = Eigen::Vector3d(msg.position_in_map.data());
  if (!track.position_in_map.allFinite()) return std::nullopt;
  if (msg.is_surveyed != 0) {
    track.survey = MeasuredPosition{Eigen::Vector3d(msg.survey_in_map.data()), msg.survey_sigma};
    if (!track.survey->position_in_map.allFinite() || !IsSigma(track.survey->sigma)) {
      return std::nullopt;
    }
  }
  if (!AppendSightings(msg, &track.sightings)) return std::nullopt;
  return track;
}

}  // namespace

plumbline::ControlPoints ToControlPointsMsg(const BundleConstraints& constraints,
                                            std::uint32_t map_sequence,
                                            const std_msgs::Header& header) {
  plumbline::ControlPoints msg;
  msg.header = header;
  msg.map_sequence = map_sequence;
  for (const MarkerTrack& track : constraints.markers) {
    msg.points.push_back(ToControlPointMsg(track));
  }
  return msg;
}

std::optional<BundleConstraints> FromControlPointsMsg(const plumbline::ControlPoints& msg) {
  BundleConstraints constraints;
  std::set<int> ids;
  for (const plumbline::ControlPoint& point : msg.points) {
    std::optional<MarkerTrack> track = FromControlPointMsg(point);
    if (!track || !ids.insert(track->marker_id).second) return std::nullopt;
    constraints.markers.push_back(std::move(*track));
  }
  return constraints;
}

}  // namespace plumb::ros_adapter
