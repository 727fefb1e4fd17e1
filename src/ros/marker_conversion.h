// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/MarkerDetection.h>
#include <plumbline/MarkerDetectionArray.h>

#include <optional>
#include <vector>

#include "plumbline/marker/marker_detector.h"

namespace plumb::ros_adapter {

plumbline::MarkerDetection ToMarkerDetectionMsg(const MarkerDetection& detection);

// Nothing if a number is not finite, a length or a variance not positive, a share not in [0, 1],
// or the ID unknown to the codebook.
std::optional<MarkerDetection> FromMarkerDetectionMsg(const plumbline::MarkerDetection& msg);

// Nothing if any detection makes no sense: then none of them is to be trusted.
std::optional<std::vector<MarkerDetection>> FromMarkerDetectionsMsg(
    const plumbline::MarkerDetectionArray& msg);

}  // namespace plumb::ros_adapter
