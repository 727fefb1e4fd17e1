// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "plumbline/map/photo_verdict.h"

namespace plumb::ros_adapter {

// Photos of the session by the status of their latest verdict.
struct PhotoCounts {
  int num_accepted = 0;
  int num_waiting = 0;
  int num_refused = 0;
};

// What the pilot looks at: the photo, reduced to at most `max_width_px`, matched points that
// agree with the pose in green and those that do not in red, under a banner with the verdict,
// its reason and hint in large letters. A photo that cannot be decoded is grey. 8-bit BGR.
// The pixels of the verdict are those of a photo `full_width_px` wide.
cv::Mat DrawAnnotatedPhoto(const std::vector<std::uint8_t>& bytes,
                           const PhotoVerdict& verdict,
                           const PhotoCounts& counts,
                           int full_width_px,
                           int full_height_px,
                           int max_width_px);

}  // namespace plumb::ros_adapter
