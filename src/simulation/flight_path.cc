// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/flight_path.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plumb {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;
constexpr int kMostStations = 100'000;

// Photos of a corner that are turned farther against each other show it from too different sides.
constexpr double kWidestTurn_rad = 45.0 * kRadPerDeg;

struct Footprint {
  double width_m;
  double height_m;
};

Footprint FootprintAt(double distance_m, const Camera& camera) {
  return {camera.width_px() / camera.lens()[kFx] * distance_m,
          camera.height_px() / camera.lens()[kFy] * distance_m};
}

// Fewest photos of `size` that cover `range` with at least `overlap`.
int NumToCover(double range_m, double size_m, double overlap) {
  if (range_m <= size_m) return 1;
  const double steps = (range_m - size_m) / (size_m * (1.0 - overlap));
  if (steps > kMostStations) {
    throw std::invalid_argument(
        "more than 100000 photos are needed; lower the overlap or fly farther away");
  }
  return 1 + static_cast<int>(std::ceil(steps - 1e-9));
}

// Middles of `num` photos that cover [low, high] evenly; one alone stands in the middle.
double Middle(double low, double high, double size, int num, int idx) {
  const double free = std::max(0.0, high - low - size);
  if (num == 1 || free == 0.0) return 0.5 * (low + high);
  return low + 0.5 * size + free * idx / (num - 1);
}

int NumRows(const FlightLeg& leg, const Footprint& footprint) {
  return NumToCover(leg.z_max_m - leg.z_min_m, footprint.height_m, leg.side_overlap);
}

double RowHeight(const FlightLeg& leg, const Footprint& footprint, int num_rows, int row) {
  return Middle(leg.z_min_m, leg.z_max_m, footprint.height_m, num_rows, row);
}

// Photos of one row of `num_rows`, where the whole leg has `num_photos`.
int ShareOf(int num_photos, int num_rows, int row) {
  return num_photos / num_rows + (row < num_photos % num_rows ? 1 : 0);
}

// `needed` photos of a row or circle just touch.
void CheckTouch(int num_photos, int num_rows, int needed) {
  if (num_photos / num_rows >= needed) return;
  std::ostringstream text;
  text << "num_photos of " << num_photos << " leaves " << num_photos / num_rows
       << " photos for each of " << num_rows
       << " rows, which then do not even touch; give num_photos at least " << num_rows * needed
       << ", lower side_overlap or raise distance_m";
  throw std::invalid_argument(text.str());
}

// Where a camera stands that looks at a place of the wall from the side.
Station LookingAt(const FlightLeg& leg, double x_m, double z_m) {
  const double yaw = leg.yaw_deg * kRadPerDeg;
  const double pitch = leg.pitch_deg * kRadPerDeg;
  const double aside_m = leg.distance_m * std::tan(yaw);
  const double below_m = leg.distance_m / std::cos(yaw) * std::tan(pitch);
  return {{x_m + aside_m, -leg.distance_m, z_m - below_m}, yaw, pitch};
}

std::vector<Station> PlanRows(const FlightLeg& leg, const Camera& camera, int num_spare) {
  const Footprint footprint = FootprintAt(leg.distance_m, camera);
  const int num_rows = NumRows(leg, footprint);
  const int by_overlap =
      num_rows * NumToCover(leg.x_max_m - leg.x_min_m, footprint.width_m, leg.forward_overlap);
  const int num_photos = leg.num_photos > 0 ? leg.num_photos + num_spare : by_overlap;
  CheckTouch(num_photos,
             num_rows,
             NumToCover(leg.x_max_m - leg.x_min_m, footprint.width_m, /*overlap=*/0.0));
  std::vector<Station> stations;
  for (int row = 0; row < num_rows; ++row) {
    const int num = ShareOf(num_photos, num_rows, row);
    const double z_m = RowHeight(leg, footprint, num_rows, row);
    for (int i = 0; i < num; ++i) {
      const int column = row % 2 == 0 ? i : num - 1 - i;
      const double x_m = Middle(leg.x_min_m, leg.x_max_m, footprint.width_m, num, column);
      stations.push_back(LookingAt(leg, x_m, z_m));
    }
  }
  return stations;
}

// The way around a building in parts, each a straight line or a quarter of a circle about a
// corner; `steps` tells how many photos a part needs.
class OrbitWay {
 public:
  OrbitWay(const Building& building, double distance_m, double step_m, double max_turn_rad)
      : building_(building), distance_m_(distance_m) {
    const double corner_steps = std::max(0.5 * kPi * distance_m / step_m, 0.5 * kPi / max_turn_rad);
    for (int side = 0; side < 4; ++side) {
      steps_[2 * side] = SideLength(side) / step_m;
      steps_[2 * side + 1] = corner_steps;
    }
  }

  double TotalSteps() const {
    double total = 0.0;
    for (const double steps : steps_) total += steps;
    return total;
  }

  Station At(double at_steps, double z_m, double pitch_rad) const {
    int part = 0;
    while (part < 7 && at_steps > steps_[part]) at_steps -= steps_[part++];
    const int side = part / 2;
    const double share = std::min(1.0, at_steps / steps_[part]);
    const double yaw = 0.5 * kPi * (side + (part % 2 == 1 ? share : 0.0));
    const double along_m = part % 2 == 1 ? SideLength(side) : share * SideLength(side);
    const Eigen::Vector2d foot = Corner(side) + along_m * Direction(0.5 * kPi * side);
    const Eigen::Vector2d outward = -Direction(yaw + 0.5 * kPi);
    const Eigen::Vector2d center = foot + distance_m_ * outward;
    return {{center.x(), center.y(), z_m}, yaw, pitch_rad};
  }

 private:
  static Eigen::Vector2d Direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
  double SideLength(int side) const {
    return side % 2 == 0 ? building_.width_m : building_.depth_m;
  }
  // Where a side begins: front, right, back, left.
  Eigen::Vector2d Corner(int side) const {
    const double x = side == 1 || side == 2 ? building_.width_m : 0.0;
    return {x, side >= 2 ? building_.depth_m : 0.0};
  }

  Building building_;
  double distance_m_;
  double steps_[8] = {};
};

std::vector<Station> PlanOrbit(const FlightLeg& leg,
                               const Camera& camera,
                               const Building& building,
                               int num_spare) {
  const Footprint footprint = FootprintAt(leg.distance_m, camera);
  const OrbitWay way(building,
                     leg.distance_m,
                     footprint.width_m * (1.0 - leg.forward_overlap),
                     leg.max_turn_deg * kRadPerDeg);
  const int num_circles = NumRows(leg, footprint);
  const int num_photos = leg.num_photos > 0
                             ? leg.num_photos + num_spare
                             : num_circles * static_cast<int>(std::ceil(way.TotalSteps()));
  const OrbitWay widest(building, leg.distance_m, footprint.width_m, kWidestTurn_rad);
  CheckTouch(num_photos, num_circles, static_cast<int>(std::ceil(widest.TotalSteps())));
  std::vector<Station> stations;
  for (int circle = 0; circle < num_circles; ++circle) {
    const int num = ShareOf(num_photos, num_circles, circle);
    const double z_m = RowHeight(leg, footprint, num_circles, circle);
    for (int i = 0; i < num; ++i) {
      stations.push_back(way.At(way.TotalSteps() * i / num, z_m, leg.pitch_deg * kRadPerDeg));
    }
  }
  return stations;
}

std::vector<Station> PlanHover(const FlightLeg& leg, int num_spare) {
  const int num_photos = leg.num_photos + num_spare;
  const Eigen::Vector3d center(
      0.5 * (leg.x_min_m + leg.x_max_m), -leg.distance_m, 0.5 * (leg.z_min_m + leg.z_max_m));
  std::vector<Station> stations;
  for (int i = 0; i < num_photos; ++i) {
    const double share = num_photos == 1 ? 0.5 : static_cast<double>(i) / (num_photos - 1);
    const double turn_deg = leg.yaw_deg + leg.sweep_deg * (0.5 - share);
    stations.push_back({center, turn_deg * kRadPerDeg, leg.pitch_deg * kRadPerDeg});
  }
  return stations;
}

// Photos between two waypoints: as the overlap of the nearer one asks for, and never turning
// by more than max_turn_deg.
double StepsBetween(const FlightLeg& leg,
                    const Camera& camera,
                    const Waypoint& a,
                    const Waypoint& b) {
  const double nearer_m = std::min(a.distance_m, b.distance_m);
  const Footprint footprint = FootprintAt(nearer_m, camera);
  const double forward_m = footprint.width_m * (1.0 - leg.forward_overlap);
  const double upward_m = footprint.height_m * (1.0 - leg.forward_overlap);
  const double turn_deg =
      std::max(std::abs(a.yaw_deg - b.yaw_deg), std::abs(a.pitch_deg - b.pitch_deg));
  return std::max({std::abs(a.x_m - b.x_m) / forward_m,
                   std::abs(a.z_m - b.z_m) / upward_m,
                   std::abs(a.distance_m - b.distance_m) / forward_m,
                   turn_deg / leg.max_turn_deg});
}

Station Between(const Waypoint& a, const Waypoint& b, double share) {
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  return {{mix(a.x_m, b.x_m), -mix(a.distance_m, b.distance_m), mix(a.z_m, b.z_m)},
          mix(a.yaw_deg, b.yaw_deg) * kRadPerDeg,
          mix(a.pitch_deg, b.pitch_deg) * kRadPerDeg};
}

std::vector<Station> PlanWaypoints(const FlightLeg& leg, const Camera& camera, int num_spare) {
  std::vector<double> reached{0.0};
  for (std::size_t i = 1; i < leg.waypoints.size(); ++i) {
    const double steps = StepsBetween(leg, camera, leg.waypoints[i - 1], leg.waypoints[i]);
    reached.push_back(reached.back() + steps);
  }
  if (!(reached.back() > 0.0 && reached.back() < kMostStations)) {
    throw std::invalid_argument("waypoints are all in one place, or too far apart; correct them");
  }
  const int num_photos = leg.num_photos > 0 ? leg.num_photos + num_spare
                                            : 1 + static_cast<int>(std::ceil(reached.back()));
  std::vector<Station> stations;
  std::size_t part = 1;
  for (int i = 0; i < num_photos; ++i) {
    const double at = num_photos == 1 ? 0.0 : reached.back() * i / (num_photos - 1);
    while (part + 1 < reached.size() && at > reached[part]) ++part;
    const double length = reached[part] - reached[part - 1];
    const double share = length > 0.0 ? std::min(1.0, (at - reached[part - 1]) / length) : 0.0;
    stations.push_back(Between(leg.waypoints[part - 1], leg.waypoints[part], share));
  }
  return stations;
}

}  // namespace

std::vector<Station> PlanStations(const FlightLeg& leg,
                                  const Camera& camera,
                                  const Building& building,
                                  int num_spare) {
  if (leg.kind == "orbit") return PlanOrbit(leg, camera, building, num_spare);
  if (leg.kind == "hover") return PlanHover(leg, num_spare);
  if (leg.kind == "waypoints") return PlanWaypoints(leg, camera, num_spare);
  return PlanRows(leg, camera, num_spare);
}

}  // namespace plumb
