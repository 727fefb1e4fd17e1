// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/PhotoVerdict.h>
#include <ros/time.h>

#include <optional>
#include <string>

#include "plumbline/map/photo_verdict.h"

namespace plumb::ros_adapter {

// All but the pixels, and of the seconds those known when a verdict is reached.
plumbline::PhotoVerdict ToVerdictMsg(const PhotoVerdict& verdict,
                                     const std::string& map_frame_id,
                                     const ros::Time& stamp);

// Nothing if a status or reason is unknown, a value not finite, or a count beyond int.
std::optional<PhotoVerdict> FromVerdictMsg(const plumbline::PhotoVerdict& msg);

}  // namespace plumb::ros_adapter
