// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/simulation/flight.h"

namespace plumb {

// What the MAV knows of itself. The world's origin lies at origin_*; x is east, y north.
struct NavigationOptions {
  double origin_lat_deg = 47.0585;
  double origin_lon_deg = 15.4605;
  double origin_alt_ellipsoid_m = 420.0;
  bool gps = true;  // Otherwise there is no fix, and no position in the photos.
  // Standard deviations of GPS without correction: from fix to fix, and of what stays the flight.
  double gps_noise_horizontal_m = 0.3;
  double gps_noise_vertical_m = 0.6;
  double gps_bias_horizontal_m = 1.2;
  double gps_bias_vertical_m = 2.5;
  double attitude_noise_deg = 0.3;
  double attitude_bias_deg = 1.0;
  double rate_hz = 5.0;  // Lines of telemetry, beside those of the photos.

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(NavigationOptions& options, Visitor&& visit) {
  visit("origin_lat_deg", options.origin_lat_deg);
  visit("origin_lon_deg", options.origin_lon_deg);
  visit("origin_alt_ellipsoid_m", options.origin_alt_ellipsoid_m);
  visit("gps", options.gps);
  visit("gps_noise_horizontal_m", options.gps_noise_horizontal_m);
  visit("gps_noise_vertical_m", options.gps_noise_vertical_m);
  visit("gps_bias_horizontal_m", options.gps_bias_horizontal_m);
  visit("gps_bias_vertical_m", options.gps_bias_vertical_m);
  visit("attitude_noise_deg", options.attitude_noise_deg);
  visit("attitude_bias_deg", options.attitude_bias_deg);
  visit("rate_hz", options.rate_hz);
}

// One line of telemetry, as measured. The body's axes: x forward (as the camera looks), y left, z
// up.
struct TelemetrySample {
  Timestamp time;
  std::optional<GeodeticPosition> position;  // Ellipsoidal height.
  Eigen::Quaterniond enu_from_body_rotation = Eigen::Quaterniond::Identity();
  int photo_idx = -1;  // Into the flight; -1: between photos.
};

// Noisy and biased telemetry of a flight, in the order of time, one sample for each photo among
// them. Deterministic. Throws std::invalid_argument listing options.Problems().
std::vector<TelemetrySample> SimulateTelemetry(const NavigationOptions& options,
                                               const std::vector<PlannedPhoto>& photos,
                                               std::uint64_t seed);

// WGS 84 of a place in the world, exact (PROJ).
GeodeticPosition ToGeodetic(const NavigationOptions& options,
                            const Eigen::Vector3d& point_in_world);

}  // namespace plumb
