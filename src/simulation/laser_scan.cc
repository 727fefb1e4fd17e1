// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/laser_scan.h"

#include <array>
#include <cmath>
#include <sstream>

#include "image/parallel_for.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/common/options.h"
#include "simulation/facade_plan.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says little-endian");

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kRangeUse = 401;
constexpr double kMargin_m = 1.0;     // Beside and below the wall.
constexpr double kTopMargin_m = 3.0;  // A cornice is seen against the sky above the wall.

// The part of a wall that one station scans, in the wall's frame.
struct Strip {
  Rigid3 world_from_wall;
  Eigen::Vector3d station_in_wall;
  double left_m;
  double right_m;
  std::uint64_t seed;
};

std::vector<Strip> PlanStrips(const FacadeOptions& facade, const LaserScanOptions& options) {
  std::vector<Strip> strips;
  for (const WallPlan& wall : PlanFacade(facade).walls) {
    if (!wall.is_main && !facade.closed) continue;
    const double step_m = wall.width_m / options.num_stations;
    for (int k = 0; k < options.num_stations; ++k) {
      Strip strip;
      strip.world_from_wall = wall.world_from_wall;
      strip.station_in_wall = {(k + 0.5) * step_m, -options.distance_m, options.height_m};
      strip.left_m = k == 0 ? -kMargin_m : k * step_m;
      strip.right_m = k + 1 == options.num_stations ? wall.width_m + kMargin_m : (k + 1) * step_m;
      strip.seed = DeriveSeed(options.seed, kRangeUse, strips.size());
      strips.push_back(strip);
    }
  }
  return strips;
}

class Scanner {
 public:
  Scanner(const World& world, const Renderer& renderer, const LaserScanOptions& options)
      : world_(world),
        renderer_(renderer),
        options_(options),
        min_cosine_(std::cos(options.max_incidence_deg * kPi / 180.0)) {}

  // The points of one row of beams, at height z on the wall's plane.
  std::vector<Eigen::Vector3d> ScanRow(const Strip& strip, double z_m, int row) const {
    const Eigen::Vector3d station = strip.world_from_wall * strip.station_in_wall;
    RandomNumbers random(DeriveSeed(strip.seed, kRangeUse, static_cast<std::uint64_t>(row)));
    const auto count =
        static_cast<int>(std::floor((strip.right_m - strip.left_m) / options_.spacing_m));
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector3d aim(strip.left_m + (k + 0.5) * options_.spacing_m, 0.0, z_m);
      const Eigen::Vector3d beam = (strip.world_from_wall * aim - station).normalized();
      const double noise_m = random.Normal(options_.range_sigma_m);
      const std::optional<RayHit> hit = renderer_.Cast(station, beam);
      if (hit && ComesBack(*hit, beam)) points.push_back(hit->point_in_world + noise_m * beam);
    }
    return points;
  }

 private:
  bool ComesBack(const RayHit& hit, const Eigen::Vector3d& beam) const {
    if (-hit.normal_in_world.dot(beam) < min_cosine_) return false;
    if (hit.triangle < 0) return true;
    const WorldTriangle& triangle = world_.triangles[static_cast<std::size_t>(hit.triangle)];
    const std::uint32_t material = world_.facets[triangle.facet].material;
    return world_.materials[material].pattern != Pattern::kGlass;
  }

  const World& world_;
  const Renderer& renderer_;
  const LaserScanOptions& options_;
  double min_cosine_;
};

}  // namespace

std::vector<std::string> LaserScanOptions::Problems() const {
  ProblemList list;
  list.Require(num_stations >= 1, "num_stations", "at least 1", num_stations);
  list.Require(height_m > 0.0, "height_m", "greater than 0", height_m);
  list.Require(distance_m >= 3.0, "distance_m", "at least 3, to clear balconies", distance_m);
  list.Require(spacing_m >= 0.001, "spacing_m", "at least 0.001", spacing_m);
  list.Require(range_sigma_m >= 0.0, "range_sigma_m", "at least 0", range_sigma_m);
  list.Require(max_incidence_deg > 0.0 && max_incidence_deg <= 90.0,
               "max_incidence_deg",
               "greater than 0 and at most 90",
               max_incidence_deg);
  return list.Take();
}

LaserScan ScanFacade(const World& world,
                     const Renderer& renderer,
                     const FacadeOptions& facade,
                     const LaserScanOptions& options,
                     int num_threads) {
  ThrowIfProblems("laser_scan", options.Problems());
  const Scanner scanner(world, renderer, options);
  const double bottom_m = -kMargin_m;
  const auto num_rows =
      static_cast<int>(std::floor((facade.height_m + kTopMargin_m - bottom_m) / options.spacing_m));
  LaserScan scan;
  for (const Strip& strip : PlanStrips(facade, options)) {
    scan.stations_in_world.push_back(strip.world_from_wall * strip.station_in_wall);
    std::vector<std::vector<Eigen::Vector3d>> rows(static_cast<std::size_t>(num_rows));
    ParallelFor(num_threads, num_rows, /*part_size=*/16, [&](int begin, int end) {
      for (int row = begin; row < end; ++row) {
        const double z_m = bottom_m + (row + 0.5) * options.spacing_m;
        rows[static_cast<std::size_t>(row)] = scanner.ScanRow(strip, z_m, row);
      }
    });
    for (const auto& row : rows) {
      scan.points_in_world.insert(scan.points_in_world.end(), row.begin(), row.end());
    }
  }
  return scan;
}

void WriteLaserPly(const LaserScan& scan, const std::string& path) {
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\n"
            "comment Plumbline simulation, laser scan, frame: world, metres\n";
  for (const Eigen::Vector3d& station : scan.stations_in_world) {
    header << "comment station " << station.x() << ' ' << station.y() << ' ' << station.z() << '\n';
  }
  header << "element vertex " << scan.points_in_world.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  std::string text = header.str();
  for (const Eigen::Vector3d& point : scan.points_in_world) {
    const Eigen::Vector3f rounded = point.cast<float>();
    text.append(reinterpret_cast<const char*>(rounded.data()), 3 * sizeof(float));
  }
  WriteFileAtomically(path, text);
}

}  // namespace plumb
