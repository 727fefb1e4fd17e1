// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "plumbline/marker/marker_detector.h"

namespace plumb::ros_adapter {

// How blurred a photo (CV_8UC1) is, by the steepness of its markers' outer edges: the sigma in
// pixels of a Gaussian blur that would make an edge as flat, across the direction of a motion. The
// pixels' own area counts as 0.5 px or so. Nothing if no marker is large enough to tell.
std::optional<double> EdgeBlur_px(const cv::Mat& gray, const std::vector<MarkerDetection>& markers);

}  // namespace plumb::ros_adapter
