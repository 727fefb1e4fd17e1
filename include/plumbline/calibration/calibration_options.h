// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct CalibrationOptions {
  // "a4" or "a3": the markers are the printed grid of that paper (LayOutGrid, fixed), whose
  // distances are known but for the printer's scale. Empty: they are strewn on a plane.
  std::string fixed_grid;

  // The grid's first ID. Other IDs are left out and named. Only where fixed_grid is given.
  int first_id = 0;

  // Of the outer circle; with it lengths are told in metres. 0: unknown, lengths are in marker
  // diameters. A fixed grid has its own. The lens does not depend on it.
  double marker_diameter_m = 0.0;

  // rational_polynomial (k1 to k6) instead of plumb_bob (k1 to k3): for wide lenses.
  bool rational = false;

  // fx = fy. Every digital camera in use has square pixels; one parameter less.
  bool square_pixels = true;

  // Range and number of the focal lengths that are tried one by one, as shares of the photo's
  // width, evenly spaced on a logarithmic scale: 118 to 11 degrees of view.
  double min_focal_per_width = 0.3;
  double max_focal_per_width = 5.0;  // The largest one.
  int num_focal_steps = 48;          // So many are tried.

  // Added to the covariance of every centre [px]: what the detector does not know of, such as
  // uneven light and the printer.
  double extra_sigma_px = 0.02;

  // Residuals beyond this count less and less (Cauchy's norm), in standard deviations.
  double robust_width = 2.5;

  // An observation is called wrong beyond this, in standard deviations.
  double max_residual_sigmas = 6.0;

  // Height of a marker over the plane, standard deviation to begin with, in marker diameters; it
  // is estimated anew from the heights found, within a tenth and ten times of this.
  double height_sigma = 0.02;

  // What counts as good: standard deviations of the focal length, of the principal point, and of
  // the distortion (LensEstimate::distortion_sigma_px).
  double max_focal_sigma_percent = 0.05;
  double max_principal_sigma_px = 1.0;   // Of the principal point.
  double max_distortion_sigma_px = 0.1;  // Of the distortion.

  // Threads of the solver; 0: one for each core. Does not change the result but for rounding.
  int num_threads = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

// The only list of the parameter names.
template <typename Visitor>
void VisitFields(CalibrationOptions& options, Visitor&& visit) {
  visit("fixed_grid", options.fixed_grid);
  visit("first_id", options.first_id);
  visit("marker_diameter_m", options.marker_diameter_m);
  visit("rational", options.rational);
  visit("square_pixels", options.square_pixels);
  visit("min_focal_per_width", options.min_focal_per_width);
  visit("max_focal_per_width", options.max_focal_per_width);
  visit("num_focal_steps", options.num_focal_steps);
  visit("extra_sigma_px", options.extra_sigma_px);
  visit("robust_width", options.robust_width);
  visit("max_residual_sigmas", options.max_residual_sigmas);
  visit("height_sigma", options.height_sigma);
  visit("max_focal_sigma_percent", options.max_focal_sigma_percent);
  visit("max_principal_sigma_px", options.max_principal_sigma_px);
  visit("max_distortion_sigma_px", options.max_distortion_sigma_px);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
