// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

struct GeoreferencerOptions {
  // Bound on the distance of a marker's centre from where its point is seen [px]. As wide as the
  // localiser's: during a flight poses wait for their bundle.
  double max_error_px = 4.0;

  // Smallest angle between two rays of a target; below it the depth is noise.
  double min_parallax_deg = 1.5;

  // Marker centres are not believed to be better than this: the poses are not.
  double min_sigma_px = 0.1;

  // A map may be bent by this part of the targets' extent: what is off by more than four times
  // that is a wrong target (RobustSimilarityOptions says why so).
  double max_bend_ratio = 0.0005;

  // Outer diameter of the markers [m], to notice a survey in another unit. 0: not known.
  double marker_diameter_m = 0.5;

  // Standard deviation of a GPS position from photo to photo, horizontally [m].
  double gps_sigma_horizontal_m = 1.0;

  // The same of its height [m].
  double gps_sigma_vertical_m = 2.0;

  // The photos' GPS goes into the bundle of `georeference --refine` as well, by its standard
  // deviations; in flight only control points do. Beside targets it weighs nothing.
  bool gps_in_bundle = false;

  // GPS without correction is off by up to this, all the flight [m]: more is said aloud.
  double max_gps_offset_m = 10.0;

  // A survey that lies farther from the photos' GPS than this is of another place [m], and refused.
  double max_gps_distance_m = 1000.0;

  // Targets must reach over this part of the model's length and height, from either side.
  double min_coverage = 0.6;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(GeoreferencerOptions& options, Visitor&& visit) {
  visit("max_error_px", options.max_error_px);
  visit("min_parallax_deg", options.min_parallax_deg);
  visit("min_sigma_px", options.min_sigma_px);
  visit("max_bend_ratio", options.max_bend_ratio);
  visit("marker_diameter_m", options.marker_diameter_m);
  visit("gps_sigma_horizontal_m", options.gps_sigma_horizontal_m);
  visit("gps_sigma_vertical_m", options.gps_sigma_vertical_m);
  visit("gps_in_bundle", options.gps_in_bundle);
  visit("max_gps_offset_m", options.max_gps_offset_m);
  visit("max_gps_distance_m", options.max_gps_distance_m);
  visit("min_coverage", options.min_coverage);
}

}  // namespace plumb
