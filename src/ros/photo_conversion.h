// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Photo.h>
#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"

namespace plumb::ros_adapter {

// A photo as it travels from the camera to the mapper, but for the camera itself.
struct WirePhoto {
  PhotoId id;
  std::string name;
  Timestamp exposure_time;
  std::optional<GeodeticPosition> position;
  Timestamp received;
  Timestamp published;
  std::vector<std::uint8_t> bytes;
};

// The times must fit ROS (FitsRosTime).
plumbline::Photo ToPhotoMsg(const WirePhoto& photo,
                            const sensor_msgs::CameraInfo& camera_info,
                            const std::string& camera_frame_id);

// Nothing if the sequence is 0 or the name empty or with a path. Whether the bytes are a
// photo is the mapper's to say.
std::optional<WirePhoto> FromPhotoMsg(const plumbline::Photo& msg);

// "jpeg", "png", "tiff", "bmp" by the first bytes; empty if it is none of them.
std::string ImageFormat(const std::vector<std::uint8_t>& bytes);

}  // namespace plumb::ros_adapter
