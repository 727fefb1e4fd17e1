// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/simulation/flight.h"

namespace plumb {

// Where the plan has a photo taken; angles as Waypoint has them.
struct Station {
  Eigen::Vector3d center_in_world;
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

// The stations of one leg without any error of the pilot's, `num_spare` more than num_photos
// asks for. Throws std::invalid_argument saying what is impossible and its cure. Precondition: the
// leg's own values are within bounds.
std::vector<Station> PlanStations(const FlightLeg& leg,
                                  const Camera& camera,
                                  const Building& building,
                                  int num_spare);

}  // namespace plumb
