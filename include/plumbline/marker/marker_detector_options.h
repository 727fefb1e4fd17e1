// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct MarkerDetectorOptions {
  // Diameters along the minor axis that are searched for. The search begins at the resolution at
  // which the smallest one has six whole pixels, so that from 12 px on its cost falls with the
  // square of this. At 10, 91 % of rendered markers of 14 px are found, and 55 % of those of 12 px.
  double min_diameter_px = 10.0;

  // A pixel is dark if it is below the mean of its surroundings by this [grey levels].
  double min_darkness = 6.0;

  // Between a marker's white and its black [grey levels].
  double min_contrast = 20.0;

  // Of the shorter axis of the outer ellipse over the longer: 0.2 is a tilt of 78 deg.
  double min_axis_ratio = 0.2;

  // Bound on the share of the grey values' variance that the marker's face explains, when it is
  // laid over the photo. Noise is not explained: of markers of 30 px with a contrast of 60, a blur
  // of 2 px and noise of 5 grey levels, 163 of 384 are found at 0.8, and 38 at 0.85.
  double min_explained = 0.8;

  // Bound on the probability of the code against all others.
  double min_probability = 0.9999;

  // Threads of one photo; 0: one for each core. Does not change the result.
  int num_threads = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(MarkerDetectorOptions& options, Visitor&& visit) {
  visit("min_diameter_px", options.min_diameter_px);
  visit("min_darkness", options.min_darkness);
  visit("min_contrast", options.min_contrast);
  visit("min_axis_ratio", options.min_axis_ratio);
  visit("min_explained", options.min_explained);
  visit("min_probability", options.min_probability);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
