// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/marker/marker_detector.h"

namespace plumb {

// What was found in one photo of the camera that is to be calibrated.
struct CalibrationPhoto {
  std::string name;  // Unique among the photos; messages name it.
  int width_px = 0;
  int height_px = 0;
  // As DetectMarkers gives them. Of each the centre with its covariance and the outer ellipse are
  // used, raw pixels both, so that it does not matter whether a camera was given.
  std::vector<MarkerDetection> markers;
};

}  // namespace plumb
