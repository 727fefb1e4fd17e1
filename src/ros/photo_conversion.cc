// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/photo_conversion.h"

#include <cmath>
#include <limits>

#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

sensor_msgs::NavSatFix ToFixMsg(const std::optional<GeodeticPosition>& position) {
  sensor_msgs::NavSatFix msg;
  msg.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  msg.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  msg.latitude = msg.longitude = msg.altitude = unknown;
  if (!position) return msg;
  msg.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
  msg.latitude = position->lat_deg;
  msg.longitude = position->lon_deg;
  msg.altitude = position->alt_m.value_or(unknown);
  return msg;
}

std::optional<GeodeticPosition> FromFixMsg(const sensor_msgs::NavSatFix& msg) {
  if (msg.status.status == sensor_msgs::NavSatStatus::STATUS_NO_FIX) return std::nullopt;
  if (!(std::abs(msg.latitude) <= 90.0) || !(std::abs(msg.longitude) <= 180.0)) return std::nullopt;
  GeodeticPosition position{msg.latitude, msg.longitude, std::nullopt};
  if (std::isfinite(msg.altitude)) position.alt_m = msg.altitude;
  return position;
}

bool IsFileName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

}  // namespace

plumbline::Photo ToPhotoMsg(const WirePhoto& photo,
                            const sensor_msgs::CameraInfo& camera_info,
                            const std::string& camera_frame_id) {
  plumbline::Photo msg;
  msg.header.stamp = ToRosTime(photo.exposure_time);
  msg.header.frame_id = camera_frame_id;
  msg.sequence = photo.id.value;
  msg.name = photo.name;
  msg.image.header = msg.header;
  msg.image.format = ImageFormat(photo.bytes);
  msg.image.data = photo.bytes;
  msg.camera_info = camera_info;
  msg.camera_info.header = msg.header;
  msg.position_prior = ToFixMsg(photo.position);
  msg.position_prior.header = msg.header;
  msg.received = ToRosTime(photo.received);
  msg.published = ToRosTime(photo.published);
  return msg;
}

std::optional<WirePhoto> FromPhotoMsg(const plumbline::Photo& msg) {
  const bool is_sound =
      msg.sequence != 0 && PhotoId{msg.sequence}.IsValid() && IsFileName(msg.name);
  if (!is_sound) return std::nullopt;
  WirePhoto photo;
  photo.id = PhotoId{msg.sequence};
  photo.name = msg.name;
  photo.exposure_time = FromRosTime(msg.header.stamp);
  photo.position = FromFixMsg(msg.position_prior);
  photo.received = FromRosTime(msg.received);
  photo.published = FromRosTime(msg.published);
  photo.bytes = msg.image.data;
  return photo;
}

std::string ImageFormat(const std::vector<std::uint8_t>& bytes) {
  const auto starts_with = [&](std::initializer_list<std::uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  if (starts_with({0xFF, 0xD8})) return "jpeg";
  if (starts_with({0x89, 'P', 'N', 'G'})) return "png";
  if (starts_with({'I', 'I', 42, 0}) || starts_with({'M', 'M', 0, 42})) return "tiff";
  if (starts_with({'B', 'M'})) return "bmp";
  return "";
}

}  // namespace plumb::ros_adapter
