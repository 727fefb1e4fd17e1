// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"

namespace plumb::tools {

// A photo on disk and what is known of how it was taken.
struct RecordedPhoto {
  std::string name;
  std::string file;
  Timestamp exposure_time;
  std::optional<GeodeticPosition> position;
};

// Writes a rosbag of photos, in the order of time, as camera_ingest would have sent them; the file
// is whole or absent. Throws std::runtime_error naming the file and the cause.
using FlightBagWriter = std::function<void(
    const std::string& path, const Camera& camera, const std::vector<RecordedPhoto>& photos)>;

}  // namespace plumb::tools
