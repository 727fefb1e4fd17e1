// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/simulation/facade.h"
#include "plumbline/simulation/renderer.h"

namespace plumb {

// A laser scanner on the ground before the facade, as the paper's ground truth was taken.
struct LaserScanOptions {
  int num_stations = 3;      // Before each wall with bays, spread over its width.
  double height_m = 1.6;     // Of the scanner above the ground.
  double distance_m = 18.0;  // From the wall.
  double spacing_m = 0.015;  // Between neighbouring beams where they meet the wall's plane.
  double range_sigma_m = 0.002;
  // A beam that meets the surface flatter than this angle from its normal does not come back.
  double max_incidence_deg = 80.0;
  std::uint32_t seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(LaserScanOptions& options, Visitor&& visit) {
  visit("num_stations", options.num_stations);
  visit("height_m", options.height_m);
  visit("distance_m", options.distance_m);
  visit("spacing_m", options.spacing_m);
  visit("range_sigma_m", options.range_sigma_m);
  visit("max_incidence_deg", options.max_incidence_deg);
  visit("seed", options.seed);
}

struct LaserScan {
  std::vector<Eigen::Vector3d> stations_in_world;
  std::vector<Eigen::Vector3d> points_in_world;  // Station after station, row after row.
};

// What the scanner sees of BuildFacade(facade): of each beam the first hit, with noise along the
// beam. Each station scans the strip of wall that is nearest to it. Glass gives no echo. The same
// whatever the number of threads (0: all cores). Throws std::invalid_argument listing
// options.Problems(). Precondition: `renderer` is of `world`, and that of `facade`.
LaserScan ScanFacade(const World& world,
                     const Renderer& renderer,
                     const FacadeOptions& facade,
                     const LaserScanOptions& options,
                     int num_threads = 0);

// Binary little-endian PLY, x, y, z as float in the world's frame, whose coordinates are small; the
// stations stand in comments. Replaces the file as a whole. Throws std::runtime_error naming the
// file, the cause and the cure.
void WriteLaserPly(const LaserScan& scan, const std::string& path);

}  // namespace plumb
