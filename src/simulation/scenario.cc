// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/scenario.h"

#include <cmath>

#include "plumbline/common/options.h"

namespace plumb {
namespace {

std::vector<std::string> ProblemsOf(const Light& light) {
  ProblemList problems;
  const double length = light.towards_sun_in_world.norm();
  problems.Require(length > 1e-6 && length < 1e6,
                   "towards_sun_in_world",
                   "a direction, not of length 0",
                   length);
  problems.Require(light.sun_irradiance >= 0.0 && light.sun_irradiance <= 10.0,
                   "sun_irradiance",
                   "in [0, 10]",
                   light.sun_irradiance);
  problems.Require(light.sky_irradiance > 0.0 && light.sky_irradiance <= 10.0,
                   "sky_irradiance",
                   "in (0, 10]",
                   light.sky_irradiance);
  return problems.Take();
}

}  // namespace

std::vector<std::string> LensOptions::Problems() const {
  ProblemList problems;
  problems.Require(width_px >= 64 && width_px <= 20'000, "width_px", "in [64, 20000]", width_px);
  problems.Require(
      height_px >= 64 && height_px <= 20'000, "height_px", "in [64, 20000]", height_px);
  problems.Require(focal_length_mm > 0.0 && focal_length_mm <= 2000.0,
                   "focal_length_mm",
                   "in (0, 2000]",
                   focal_length_mm);
  problems.Require(sensor_width_mm > 0.0 && sensor_width_mm <= 100.0,
                   "sensor_width_mm",
                   "in (0, 100]",
                   sensor_width_mm);
  problems.Require(std::abs(wrong_focal_percent) <= 10.0,
                   "wrong_focal_percent",
                   "in [-10, 10]",
                   wrong_focal_percent);
  problems.Require(
      std::abs(wrong_corner_px) <= 100.0, "wrong_corner_px", "in [-100, 100]", wrong_corner_px);
  return problems.Take();
}

std::vector<std::string> Scenario::Problems() const {
  ProblemList problems;
  problems.Require(samples_per_axis >= 1 && samples_per_axis <= 16,
                   "samples_per_axis",
                   "in [1, 16]",
                   samples_per_axis);
  problems.Append("facade", facade.Problems());
  problems.Append("floor", floor.Problems());
  problems.Append("light", ProblemsOf(light));
  problems.Append("lens", lens.Problems());
  problems.Append("sensor", sensor.Problems());
  problems.Append("navigation", navigation.Problems());
  FlightOptions flown = flight;
  if (floor.num_photos > 0 && flown.legs.empty()) flown.legs.emplace_back();  // None is flown.
  problems.Append("flight", flown.Problems());
  problems.Append("survey", survey.Problems());
  problems.Append("laser", laser.Problems());
  return problems.Take();
}

Camera MakeTrueCamera(const LensOptions& options) {
  ThrowIfProblems("lens", options.Problems());
  if (!options.file.empty()) return ReadCameraYaml(options.file);
  const double focal_px = options.focal_length_mm / options.sensor_width_mm * options.width_px;
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = focal_px;
  lens[kCx] = 0.5 * (options.width_px - 1) + options.cx_offset_px;
  lens[kCy] = 0.5 * (options.height_px - 1) + options.cy_offset_px;
  lens[kK1] = options.k1;
  lens[kK2] = options.k2;
  lens[kP1] = options.p1;
  lens[kP2] = options.p2;
  lens[kK3] = options.k3;
  return Camera("simulated", options.width_px, options.height_px, DistortionModel::kPlumbBob, lens);
}

Camera MakeWrongCamera(const LensOptions& options) {
  const Camera camera = MakeTrueCamera(options);
  LensParameters<double> lens = camera.lens();
  const double radius =
      0.5 * std::hypot(camera.width_px(), camera.height_px()) / camera.MeanFocalLength();
  lens[kFx] *= 1.0 + 0.01 * options.wrong_focal_percent;
  lens[kFy] *= 1.0 + 0.01 * options.wrong_focal_percent;
  lens[kK1] += options.wrong_corner_px / camera.MeanFocalLength() / std::pow(radius, 3);
  return Camera(
      camera.name() + "_wrong", camera.width_px(), camera.height_px(), camera.model(), lens);
}

}  // namespace plumb
