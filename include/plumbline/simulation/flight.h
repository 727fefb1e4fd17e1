// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/flight_options.h"

namespace plumb {

// One photo of a flight, as it truly is. The world is that of world.h.
struct PlannedPhoto {
  std::string name;  // 0001.jpg, or 0001_4m.jpg where the leg names a row; by time.
  std::string row;
  double distance_m = 0.0;  // Planned, from the wall or building.
  Timestamp exposure_time;
  Rigid3 cam_from_world;
  Eigen::Vector3d velocity_in_cam_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rate_in_cam_rad_s = Eigen::Vector3d::Zero();
};

struct Building {
  double width_m = 50.0;  // Along x, from 0.
  double depth_m = 12.0;  // Along y, from 0.
};

// The flight of `options`, in the order of time. Deterministic. Throws std::invalid_argument
// listing options.Problems(), or naming the leg and what is impossible in it with its cure.
std::vector<PlannedPhoto> PlanFlight(const FlightOptions& options,
                                     const Camera& camera,
                                     const Building& building,
                                     std::uint64_t seed);

}  // namespace plumb
