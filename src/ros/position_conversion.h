// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/PhotoPositions.h>
#include <std_msgs/Header.h>

#include <map>
#include <optional>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/image/photo_analysis.h"

namespace plumb::ros_adapter {

struct PhotoPositions {
  std::optional<Camera> camera;  // Nothing while it is not known.
  std::map<PhotoId, GeodeticPosition> position_of_photo;
};

plumbline::PhotoPositions ToPhotoPositionsMsg(const PhotoPositions& positions,
                                              const std_msgs::Header& header);

// Leaves out a position that is on no earth, and a height that is on none. Nothing if the arrays
// differ in length, or the camera, where there is one, makes no sense.
std::optional<PhotoPositions> FromPhotoPositionsMsg(const plumbline::PhotoPositions& msg);

}  // namespace plumb::ros_adapter
