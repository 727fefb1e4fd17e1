// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/ControlPoints.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>

#include "plumbline/sfm/bundle_constraints.h"

namespace plumb::ros_adapter {

// The markers; `map_sequence` is that of the map they were computed for.
plumbline::ControlPoints ToControlPointsMsg(const BundleConstraints& constraints,
                                            std::uint32_t map_sequence,
                                            const std_msgs::Header& header);

// Nothing if arrays that belong together differ in length, a number is not finite, a standard
// deviation not positive, or a marker or a photo of it is there twice: then none is to be trusted.
std::optional<BundleConstraints> FromControlPointsMsg(const plumbline::ControlPoints& msg);

}  // namespace plumb::ros_adapter
