// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/position_conversion.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ros/camera_conversion.h"

namespace plumb::ros_adapter {
namespace {

// From below the Dead Sea to above whatever flies with a camera [m].
constexpr double kLowest_m = -1000.0;
constexpr double kHighest_m = 50000.0;

}  // namespace

plumbline::PhotoPositions ToPhotoPositionsMsg(const PhotoPositions& positions,
                                              const std_msgs::Header& header) {
  plumbline::PhotoPositions msg;
  msg.header = header;
  if (positions.camera) {
    msg.camera_info = ToCameraInfoMsg(*positions.camera);
    msg.camera_info.header = header;
  }
  for (const auto& [photo, position] : positions.position_of_photo) {
    msg.sequences.push_back(photo.value);
    msg.lats_deg.push_back(position.lat_deg);
    msg.lons_deg.push_back(position.lon_deg);
    msg.alts_ellipsoid_m.push_back(
        position.alt_m.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return msg;
}

std::optional<PhotoPositions> FromPhotoPositionsMsg(const plumbline::PhotoPositions& msg) {
  const std::size_t num = msg.sequences.size();
  if (msg.lats_deg.size() != num || msg.lons_deg.size() != num ||
      msg.alts_ellipsoid_m.size() != num) {
    return std::nullopt;
  }
  PhotoPositions positions;
  try {
    if (msg.camera_info.width != 0) {
      positions.camera = FromCameraInfoMsg(msg.camera_info, "camera");
    }
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < num; ++i) {
    GeodeticPosition position{msg.lats_deg[i], msg.lons_deg[i], std::nullopt};
    const bool is_on_earth =
        std::abs(position.lat_deg) <= 90.0 && std::abs(position.lon_deg) <= 180.0;
    if (!is_on_earth || !PhotoId{msg.sequences[i]}.IsValid()) continue;
    const double alt_m = msg.alts_ellipsoid_m[i];
    if (alt_m > kLowest_m && alt_m < kHighest_m) position.alt_m = alt_m;
    positions.position_of_photo[PhotoId{msg.sequences[i]}] = position;
  }
  return positions;
}

}  // namespace plumb::ros_adapter
