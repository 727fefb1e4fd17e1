// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_detector_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> MarkerDetectorOptions::Problems() const {
  ProblemList problems;
  problems.Require(
      min_diameter_px >= 6.0, "min_diameter_px", "at least 6, the smallest seen", min_diameter_px);
  problems.Require(min_darkness >= 1.0 && min_darkness <= 128.0,
                   "min_darkness",
                   "1 to 128 grey levels",
                   min_darkness);
  problems.Require(min_contrast >= 1.0 && min_contrast <= 255.0,
                   "min_contrast",
                   "1 to 255 grey levels",
                   min_contrast);
  problems.Require(
      min_axis_ratio > 0.0 && min_axis_ratio <= 1.0, "min_axis_ratio", "in (0, 1]", min_axis_ratio);
  problems.Require(
      min_explained >= 0.0 && min_explained < 1.0, "min_explained", "in [0, 1)", min_explained);
  problems.Require(min_probability >= 0.0 && min_probability < 1.0,
                   "min_probability",
                   "in [0, 1)",
                   min_probability);
  problems.Require(num_threads >= 0, "num_threads", "at least 0", num_threads);
  return problems.Take();
}

}  // namespace plumb
