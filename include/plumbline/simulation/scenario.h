// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/simulation/facade.h"
#include "plumbline/simulation/flight_options.h"
#include "plumbline/simulation/laser_scan.h"
#include "plumbline/simulation/marker_floor.h"
#include "plumbline/simulation/navigation.h"
#include "plumbline/simulation/renderer.h"
#include "plumbline/simulation/sensor_options.h"
#include "plumbline/simulation/survey.h"

namespace plumb {

// The lens and the size of the sensor; by default the paper's, 16 mm on APS-C.
struct LensOptions {
  std::string file;  // A camera_info YAML: all of the lens but its lengths in millimetres.
  int width_px = 4912;
  int height_px = 3264;
  double focal_length_mm = 16.0;
  double sensor_width_mm = 23.5;
  double cx_offset_px = 8.3;  // Of the principal point from the photo's middle.
  double cy_offset_px = -5.7;
  double k1 = -0.072;  // plumb_bob.
  double k2 = 0.041;
  double p1 = 0.0004;
  double p2 = -0.0003;
  double k3 = 0.0;
  // camera_wrong.yaml: a focal length too long by a share, and so far off in the corners.
  double wrong_focal_percent = 0.2;
  double wrong_corner_px = 3.0;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(LensOptions& options, Visitor&& visit) {
  visit("file", options.file);
  visit("width_px", options.width_px);
  visit("height_px", options.height_px);
  visit("focal_length_mm", options.focal_length_mm);
  visit("sensor_width_mm", options.sensor_width_mm);
  visit("cx_offset_px", options.cx_offset_px);
  visit("cy_offset_px", options.cy_offset_px);
  visit("k1", options.k1);
  visit("k2", options.k2);
  visit("p1", options.p1);
  visit("p2", options.p2);
  visit("k3", options.k3);
  visit("wrong_focal_percent", options.wrong_focal_percent);
  visit("wrong_corner_px", options.wrong_corner_px);
}

template <typename Visitor>
void VisitFields(Light& light, Visitor&& visit) {
  visit("towards_sun_in_world", light.towards_sun_in_world);
  visit("sun_irradiance", light.sun_irradiance);
  visit("sky_irradiance", light.sky_irradiance);
}

// All that a simulated flight depends on: the same scenario gives the same bytes.
struct Scenario {
  std::string description;
  std::uint32_t seed = 1;  // Of the flight and all noise; the facade has a seed of its own.
  int samples_per_axis = 2;
  FacadeOptions facade;
  // With photos of it, they are all that is taken: there is no facade, no flight and no laser scan.
  MarkerFloorOptions floor;
  Light light;
  LensOptions lens;
  SensorOptions sensor;
  NavigationOptions navigation;
  FlightOptions flight;
  SurveyOptions survey;
  LaserScanOptions laser;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(Scenario& scenario, Visitor&& visit) {
  visit("description", scenario.description);
  visit("seed", scenario.seed);
  visit("samples_per_axis", scenario.samples_per_axis);
  visit("facade", scenario.facade);
  visit("floor", scenario.floor);
  visit("light", scenario.light);
  visit("lens", scenario.lens);
  visit("sensor", scenario.sensor);
  visit("navigation", scenario.navigation);
  visit("flight", scenario.flight);
  visit("survey", scenario.survey);
  visit("laser", scenario.laser);
}

// The camera that takes the photos. Throws std::invalid_argument for a lens that folds the image
// and what else Camera refuses, std::runtime_error for its file.
Camera MakeTrueCamera(const LensOptions& options);

// What a careless calibration would say of it.
Camera MakeWrongCamera(const LensOptions& options);

}  // namespace plumb
