// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "plumbline/marker/ellipse.h"
#include "plumbline/marker/marker_detector_options.h"

namespace plumb {

// A dark blob with an elliptic outline, as found at a reduced resolution.
struct MarkerCandidate {
  Ellipse ellipse;         // In pixels of the full resolution.
  double reduction = 1.0;  // Full-resolution pixels per pixel of where it was found.
};

// Outlines of dark blobs that an outer circle might have made. Deterministic.
std::vector<MarkerCandidate> FindCandidates(const MarkerDetectorOptions& options,
                                            const cv::Mat& gray);

}  // namespace plumb
