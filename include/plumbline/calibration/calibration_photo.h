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
  std::vector<MarkerDetection> markers;  // As DetectMarkers gives them.
  // DetectMarkers was given a camera. Without one its centres are off by how the distortion changes
  // over a marker's face, some tenths of a pixel for a marker of 300 px, which is corrected here.
  bool is_lens_known = false;
};

}  // namespace plumb
