// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/marker_search.h"

#include <exception>

#include "plumbline/common/stopwatch.h"
#include "plumbline/image/gray_photo.h"

namespace plumb::ros_adapter {

MarkerSearch SearchForMarkers(const MarkerDetectorOptions& options,
                              const Camera& camera,
                              const std::vector<std::uint8_t>& bytes) {
  MarkerSearch search;
  Stopwatch stopwatch;
  try {
    GrayPhoto photo = DecodeGrayPhoto(bytes, options.num_threads);
    search.gray = photo.gray;
    search.problem = photo.problem;
    search.decode_s = stopwatch.Restart();
    if (search.problem.empty()) search.detections = DetectMarkers(options, search.gray, &camera);
  } catch (const std::exception& error) {  // Another size than the camera's, or no memory left.
    search.problem = error.what();
  }
  search.detect_s = stopwatch.Seconds();
  return search;
}

}  // namespace plumb::ros_adapter
