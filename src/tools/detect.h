// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/marker/marker_detector.h"

namespace plumb::tools {

// What was found in one photo.
struct DetectedPhoto {
  std::string name;     // Its path below the folder.
  std::string problem;  // Why it could not be read; empty if it could.
  int width_px = 0;
  int height_px = 0;
  double decode_cpu_s = 0.0;
  double detect_cpu_s = 0.0;
  double wall_s = 0.0;
  std::vector<MarkerDetection> markers;
};

// Never throws for what the file holds; a photo that is not of the camera's size has a problem.
DetectedPhoto DetectInPhoto(const MarkerDetectorOptions& options,
                            const std::optional<Camera>& camera,
                            const std::string& folder,
                            const std::string& name);

// One line a marker, under a line of column names with units.
std::string ToCsv(const std::vector<DetectedPhoto>& photos);

// An object with a list "photos"; a marker's numbers as in MarkerDetection.
std::string ToJson(const std::vector<DetectedPhoto>& photos);

}  // namespace plumb::tools
