// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/MapDelta.h>
#include <ros/time.h>

#include <optional>
#include <string>

#include "plumbline/map/map_delta.h"

namespace plumb::ros_adapter {

// The times of exposure must fit ROS (FitsRosTime).
plumbline::MapDelta ToMapDeltaMsg(const MapDelta& delta,
                                  const std::string& map_frame_id,
                                  const ros::Time& stamp);

// Nothing if arrays that belong together differ in length, a value is not finite or a
// quaternion is not of unit length.
std::optional<MapDelta> FromMapDeltaMsg(const plumbline::MapDelta& msg);

}  // namespace plumb::ros_adapter
