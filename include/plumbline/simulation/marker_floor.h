// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/simulation/flight.h"
#include "plumbline/simulation/world.h"

namespace plumb {

// A floor with coded markers, to calibrate a camera with; z = 0 is the floor, the markers lie about
// the origin.
struct MarkerFloorOptions {
  // 0: there is no such floor, the scenario is a flight before a facade.
  int num_photos = 0;

  // Otherwise the fixed A4 or A3 grid on a sheet: "a4", "a3"; empty: four by four markers strewn.
  std::string fixed_grid;
  int first_id = 0;

  // Of strewn markers: diameter, and from place to place. Each is off its place by up to a
  // fifth of that, and turned at random.
  double diameter_m = 0.097;  // Four on a sheet of A3.
  double spacing_m = 0.34;

  // Strewn or not, the markers' heights follow an arch so high in its middle.
  double bend_m = 0.0;

  // Photos: from so near that the markers are wider than the image to so far that they are not.
  double min_fill = 0.55;
  double max_fill = 1.3;
  double max_tilt_deg = 45.0;

  std::uint32_t seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(MarkerFloorOptions& options, Visitor&& visit) {
  visit("num_photos", options.num_photos);
  visit("fixed_grid", options.fixed_grid);
  visit("first_id", options.first_id);
  visit("diameter_m", options.diameter_m);
  visit("spacing_m", options.spacing_m);
  visit("bend_m", options.bend_m);
  visit("min_fill", options.min_fill);
  visit("max_fill", options.max_fill);
  visit("max_tilt_deg", options.max_tilt_deg);
  visit("seed", options.seed);
}

// Throws std::invalid_argument listing options.Problems(). Deterministic.
World BuildMarkerFloor(const MarkerFloorOptions& options);

// Photos of it, named by number: tilts, directions, distances and quarter turns of the camera
// change independently. The camera stands still. Deterministic. Throws as above.
std::vector<PlannedPhoto> PlanFloorPhotos(const MarkerFloorOptions& options,
                                          const Camera& camera,
                                          Timestamp start);

}  // namespace plumb
