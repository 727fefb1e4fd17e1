// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/sensor_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> SensorOptions::Problems() const {
  ProblemList problems;
  problems.Require(daylight > 0.0 && daylight <= 2.0, "daylight", "in (0, 2]", daylight);
  problems.Require(f_number >= 0.7 && f_number <= 64.0, "f_number", "in [0.7, 64]", f_number);
  problems.Require(metering_target > 0.0 && metering_target < 1.0,
                   "metering_target",
                   "in (0, 1)",
                   metering_target);
  problems.Require(max_exposure_s > 0.0 && max_exposure_s <= 30.0,
                   "max_exposure_s",
                   "in (0, 30]",
                   max_exposure_s);
  problems.Require(min_iso >= 25 && min_iso <= 65000, "min_iso", "in [25, 65000]", min_iso);
  problems.Require(max_iso >= min_iso && max_iso <= 65000,
                   "max_iso",
                   "in [min_iso, 65000], which EXIF can hold",
                   max_iso);
  problems.Require(vignetting >= 0.0 && vignetting < 1.0, "vignetting", "in [0, 1)", vignetting);
  problems.Require(
      lens_blur_px >= 0.0 && lens_blur_px <= 10.0, "lens_blur_px", "in [0, 10]", lens_blur_px);
  problems.Require(focus_distance_m == 0.0 || focus_distance_m >= 0.1,
                   "focus_distance_m",
                   "0, or at least 0.1",
                   focus_distance_m);
  problems.Require(full_well_electrons >= 100.0 && full_well_electrons <= 1e7,
                   "full_well_electrons",
                   "in [100, 1e7]",
                   full_well_electrons);
  problems.Require(read_noise_electrons >= 0.0 && read_noise_electrons <= 1000.0,
                   "read_noise_electrons",
                   "in [0, 1000]",
                   read_noise_electrons);
  problems.Require(
      jpeg_quality >= 1 && jpeg_quality <= 100, "jpeg_quality", "in [1, 100]", jpeg_quality);
  return problems.Take();
}

}  // namespace plumb
