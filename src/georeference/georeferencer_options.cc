// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeferencer_options.h"

namespace plumb {

std::vector<std::string> GeoreferencerOptions::Problems() const {
  ProblemList problems;
  problems.Require(max_error_px > 0.0, "max_error_px", "greater than 0", max_error_px);
  problems.Require(min_parallax_deg > 0.0 && min_parallax_deg < 90.0,
                   "min_parallax_deg",
                   "between 0 and 90",
                   min_parallax_deg);
  problems.Require(min_sigma_px > 0.0, "min_sigma_px", "greater than 0", min_sigma_px);
  problems.Require(max_bend_ratio >= 0.0 && max_bend_ratio < 0.1,
                   "max_bend_ratio",
                   "at least 0 and below 0.1",
                   max_bend_ratio);
  problems.Require(marker_diameter_m >= 0.0, "marker_diameter_m", "at least 0", marker_diameter_m);
  problems.Require(gps_sigma_horizontal_m > 0.0,
                   "gps_sigma_horizontal_m",
                   "greater than 0",
                   gps_sigma_horizontal_m);
  problems.Require(
      gps_sigma_vertical_m > 0.0, "gps_sigma_vertical_m", "greater than 0", gps_sigma_vertical_m);
  problems.Require(max_gps_offset_m > 0.0, "max_gps_offset_m", "greater than 0", max_gps_offset_m);
  problems.Require(
      max_gps_distance_m > 0.0, "max_gps_distance_m", "greater than 0", max_gps_distance_m);
  problems.Require(
      min_coverage >= 0.0 && min_coverage <= 1.0, "min_coverage", "from 0 to 1", min_coverage);
  return problems.Take();
}

}  // namespace plumb
