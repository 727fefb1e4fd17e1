// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

// From the light that falls on the sensor to the file that the camera leaves.
struct SensorOptions {
  std::string make = "Plumbline";
  std::string model = "Simulated camera";

  // Brightness of the scene: 1 is full sun, 0.1 an overcast day.
  double daylight = 1.0;
  double f_number = 5.6;
  // Each photo is metered anew, in thirds of a stop; otherwise all are taken as the first of the
  // flight's bounds: max_exposure_s at min_iso.
  bool auto_exposure = true;
  // Mean of the photo that metering aims at, linear.
  double metering_target = 0.2;
  // Sensitivity is raised only where this is too short.
  double max_exposure_s = 0.001;
  int min_iso = 100;
  int max_iso = 3200;

  // Share of the light that is lost in the corners, 0..1.
  double vignetting = 0.3;

  // Sigma of what lens, anti-alias filter and demosaicing blur, beyond the pixel's own area.
  double lens_blur_px = 0.5;
  // By the camera's velocity and turning during the exposure.
  bool motion_blur = true;
  // 0: each photo is focused; otherwise what is nearer or farther is blurred.
  double focus_distance_m = 0.0;

  bool noise = true;
  // Of one pixel at ISO 100, about 2000 electrons for each square micrometre.
  double full_well_electrons = 40000.0;
  double read_noise_electrons = 4.0;

  // sRGB; otherwise the file holds linear values.
  bool tone_curve = true;
  int jpeg_quality = 92;
  bool exif = true;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(SensorOptions& options, Visitor&& visit) {
  visit("make", options.make);
  visit("model", options.model);
  visit("daylight", options.daylight);
  visit("f_number", options.f_number);
  visit("auto_exposure", options.auto_exposure);
  visit("metering_target", options.metering_target);
  visit("max_exposure_s", options.max_exposure_s);
  visit("min_iso", options.min_iso);
  visit("max_iso", options.max_iso);
  visit("vignetting", options.vignetting);
  visit("lens_blur_px", options.lens_blur_px);
  visit("motion_blur", options.motion_blur);
  visit("focus_distance_m", options.focus_distance_m);
  visit("noise", options.noise);
  visit("full_well_electrons", options.full_well_electrons);
  visit("read_noise_electrons", options.read_noise_electrons);
  visit("tone_curve", options.tone_curve);
  visit("jpeg_quality", options.jpeg_quality);
  visit("exif", options.exif);
}

}  // namespace plumb
