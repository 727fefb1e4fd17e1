// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/marker/marker_detector.h"

namespace plumb::ros_adapter {

// What a search for markers gave.
struct MarkerSearch {
  cv::Mat gray;         // CV_8UC1; empty if the photo could not be decoded.
  std::string problem;  // Why it was not searched, in words; empty if it was.
  std::vector<MarkerDetection> detections;
  double decode_s = 0.0;
  double detect_s = 0.0;
};

// Decodes a photo and searches it. Never throws for what the bytes hold. Thread-safe.
MarkerSearch SearchForMarkers(const MarkerDetectorOptions& options,
                              const Camera& camera,
                              const std::vector<std::uint8_t>& bytes);

}  // namespace plumb::ros_adapter
