// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibration_options.h"

#include "plumbline/common/options.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_sheet.h"

namespace plumb {

std::vector<std::string> CalibrationOptions::Problems() const {
  ProblemList problems;
  problems.Require(fixed_grid.empty() || fixed_grid == "a4" || fixed_grid == "a3",
                   "fixed_grid",
                   "a4, a3 or empty",
                   fixed_grid);
  const int last_id = MarkerCodebook::Get().size() - kGridSide * kGridSide;
  problems.Require(first_id >= 0 && first_id <= last_id,
                   "first_id",
                   ("in [0, " + std::to_string(last_id) + "]").c_str(),
                   first_id);
  problems.Require(marker_diameter_m >= 0.0 && marker_diameter_m <= 100.0,
                   "marker_diameter_m",
                   "in [0, 100]",
                   marker_diameter_m);
  problems.Require(min_focal_per_width >= 0.05 && min_focal_per_width <= 100.0,
                   "min_focal_per_width",
                   "in [0.05, 100]",
                   min_focal_per_width);
  problems.Require(max_focal_per_width > min_focal_per_width && max_focal_per_width <= 100.0,
                   "max_focal_per_width",
                   "above min_focal_per_width, up to 100",
                   max_focal_per_width);
  problems.Require(num_focal_steps >= 8 && num_focal_steps <= 1000,
                   "num_focal_steps",
                   "in [8, 1000]",
                   num_focal_steps);
  problems.Require(extra_sigma_px > 0.0 && extra_sigma_px <= 10.0,
                   "extra_sigma_px",
                   "in (0, 10]",
                   extra_sigma_px);
  problems.Require(
      robust_width >= 1.0 && robust_width <= 100.0, "robust_width", "in [1, 100]", robust_width);
  problems.Require(max_residual_sigmas >= 3.0 && max_residual_sigmas <= 1000.0,
                   "max_residual_sigmas",
                   "in [3, 1000]",
                   max_residual_sigmas);
  problems.Require(
      height_sigma > 0.0 && height_sigma <= 1.0, "height_sigma", "in (0, 1]", height_sigma);
  problems.Require(
      max_focal_sigma_percent > 0.0, "max_focal_sigma_percent", "above 0", max_focal_sigma_percent);
  problems.Require(
      max_principal_sigma_px > 0.0, "max_principal_sigma_px", "above 0", max_principal_sigma_px);
  problems.Require(
      max_distortion_sigma_px > 0.0, "max_distortion_sigma_px", "above 0", max_distortion_sigma_px);
  problems.Require(num_threads >= 0, "num_threads", "at least 0", num_threads);
  return problems.Take();
}

}  // namespace plumb
