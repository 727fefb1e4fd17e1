// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "ros/marker_search.h"

namespace plumb::ros_adapter {

// What the operator looks at: the grey photo, reduced to at most `max_width_px`, each marker's
// outer circle, centre and ID in green, those of an ID that is there twice in yellow, under a
// banner that counts them or says why there are none. 8-bit BGR.
cv::Mat DrawAnnotatedMarkers(const MarkerSearch& search, const std::string& name, int max_width_px);

}  // namespace plumb::ros_adapter
