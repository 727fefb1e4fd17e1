// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb::ros_adapter {

// Which images of a video are taken. Photos of a folder are all taken.
struct ViewChoiceOptions {
  // Fewer markers do not tell where the plane is.
  int min_markers = 4;

  // Sigma of the blur at the markers' edges [px]; a sharp image has about 0.8.
  double max_blur_px = 1.6;

  // The markers may move so fast over the image [image widths a second]: a rolling shutter, read in
  // a thirtieth of a second, bends an image of 1280 px by 1 px at 0.025.
  double max_speed_widths_s = 0.025;

  // Images farther apart in time [s] are photos; how the camera moved in between does not matter.
  double max_video_gap_s = 0.5;

  // A view counts as new if, against each one taken, the markers lie elsewhere by this [image
  // widths] ...
  double min_shift_widths = 0.12;

  // ... or their pattern has changed by this share of its size, by distance, tilt or turn. From a
  // view from straight above to one tilted by 20 deg it is 0.06 to 0.09, the nearer the more.
  double min_shape_change = 0.06;

  // So many are taken; each further one makes the estimate slower.
  int max_views = 80;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(ViewChoiceOptions& options, Visitor&& visit) {
  visit("min_markers", options.min_markers);
  visit("max_blur_px", options.max_blur_px);
  visit("max_speed_widths_s", options.max_speed_widths_s);
  visit("max_video_gap_s", options.max_video_gap_s);
  visit("min_shift_widths", options.min_shift_widths);
  visit("min_shape_change", options.min_shape_change);
  visit("max_views", options.max_views);
}

}  // namespace plumb::ros_adapter
