// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/flight_options.h"

#include <algorithm>
#include <cmath>

#include "plumbline/common/options.h"
#include "simulation/utc_time.h"

namespace plumb {
namespace {

// Far beyond any facade, and every sum of such values stays exact enough.
constexpr double kFarthest_m = 10'000.0;

bool IsIn(double value, double low, double high) { return value >= low && value <= high; }

bool IsRowName(const std::string& row) {
  return row.size() <= 32 && std::all_of(row.begin(), row.end(), [](char letter) {
           const bool is_letter =
               (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
           return is_letter || (letter >= '0' && letter <= '9') || letter == '-';
         });
}

std::vector<std::string> ProblemsOf(const PilotOptions& pilot) {
  ProblemList problems;
  const auto require = [&](double value, double high, const char* field, const char* bound) {
    problems.Require(IsIn(value, 0.0, high), field, bound, value);
  };
  require(pilot.position_jitter_m, 10.0, "position_jitter_m", "in [0, 10]");
  require(pilot.attitude_jitter_deg, 45.0, "attitude_jitter_deg", "in [0, 45]");
  require(pilot.drift_m, 100.0, "drift_m", "in [0, 100]");
  require(pilot.num_gaps, 1000.0, "num_gaps", "in [0, 1000]");
  require(pilot.gap_photos - 1.0, 999.0, "gap_photos", "in [1, 1000]");
  require(pilot.num_wrong_turns, 1000.0, "num_wrong_turns", "in [0, 1000]");
  require(pilot.wrong_turn_photos - 1.0, 999.0, "wrong_turn_photos", "in [1, 1000]");
  require(pilot.wrong_turn_deg, 180.0, "wrong_turn_deg", "in [0, 180]");
  require(pilot.sway_m_s, 10.0, "sway_m_s", "in [0, 10]");
  require(pilot.shake_deg_s, 360.0, "shake_deg_s", "in [0, 360]");
  return problems.Take();
}

std::vector<std::string> ProblemsOf(const Waypoint& waypoint) {
  ProblemList problems;
  const auto require = [&](double value, double bound, const char* field, const char* text) {
    problems.Require(IsIn(value, -bound, bound), field, text, value);
  };
  require(waypoint.x_m, kFarthest_m, "x_m", "in [-10000, 10000]");
  require(waypoint.distance_m, kFarthest_m, "distance_m", "in [-10000, 10000]");
  require(waypoint.z_m, kFarthest_m, "z_m", "in [-10000, 10000]");
  require(waypoint.yaw_deg, 720.0, "yaw_deg", "in [-720, 720]");
  require(waypoint.pitch_deg, 90.0, "pitch_deg", "in [-90, 90]");
  return problems.Take();
}

void CheckArea(const FlightLeg& leg, ProblemList* problems) {
  problems->Require(
      IsIn(leg.x_min_m, -kFarthest_m, kFarthest_m), "x_min_m", "in [-10000, 10000]", leg.x_min_m);
  problems->Require(leg.x_max_m > leg.x_min_m && leg.x_max_m <= kFarthest_m,
                    "x_max_m",
                    "more than x_min_m and at most 10000",
                    leg.x_max_m);
  problems->Require(
      IsIn(leg.z_min_m, -kFarthest_m, kFarthest_m), "z_min_m", "in [-10000, 10000]", leg.z_min_m);
  problems->Require(leg.z_max_m > leg.z_min_m && leg.z_max_m <= kFarthest_m,
                    "z_max_m",
                    "more than z_min_m and at most 10000",
                    leg.z_max_m);
}

std::vector<std::string> ProblemsOf(const FlightLeg& leg) {
  ProblemList problems;
  const std::vector<std::string> kinds{"rows", "orbit", "hover", "waypoints"};
  problems.Require(std::find(kinds.begin(), kinds.end(), leg.kind) != kinds.end(),
                   "kind",
                   "rows, orbit, hover or waypoints",
                   leg.kind);
  problems.Require(IsRowName(leg.row), "row", "of letters, digits and -, at most 32", leg.row);
  problems.Require(
      IsIn(leg.distance_m, 0.1, kFarthest_m), "distance_m", "in [0.1, 10000]", leg.distance_m);
  CheckArea(leg, &problems);
  problems.Require(
      IsIn(leg.forward_overlap, 0.0, 0.98), "forward_overlap", "in [0, 0.98]", leg.forward_overlap);
  problems.Require(
      IsIn(leg.side_overlap, 0.0, 0.98), "side_overlap", "in [0, 0.98]", leg.side_overlap);
  problems.Require(IsIn(leg.num_photos, leg.kind == "hover" ? 1 : 0, 100'000),
                   "num_photos",
                   leg.kind == "hover" ? "in [1, 100000] to hover" : "in [0, 100000]",
                   leg.num_photos);
  problems.Require(IsIn(leg.yaw_deg, -80.0, 80.0), "yaw_deg", "in [-80, 80]", leg.yaw_deg);
  problems.Require(IsIn(leg.pitch_deg, -80.0, 80.0), "pitch_deg", "in [-80, 80]", leg.pitch_deg);
  problems.Require(IsIn(leg.sweep_deg, 0.0, 360.0), "sweep_deg", "in [0, 360]", leg.sweep_deg);
  problems.Require(
      IsIn(leg.max_turn_deg, 0.1, 90.0), "max_turn_deg", "in [0.1, 90]", leg.max_turn_deg);
  problems.Require(leg.kind != "waypoints" || leg.waypoints.size() >= 2,
                   "waypoints",
                   "at least two",
                   static_cast<int>(leg.waypoints.size()));
  for (std::size_t i = 0; i < leg.waypoints.size(); ++i) {
    problems.Append("waypoints[" + std::to_string(i) + ']', ProblemsOf(leg.waypoints[i]));
  }
  problems.Require(IsIn(leg.speed_m_s, 0.01, 30.0), "speed_m_s", "in [0.01, 30]", leg.speed_m_s);
  problems.Require(IsIn(leg.min_interval_s, 0.01, 600.0),
                   "min_interval_s",
                   "in [0.01, 600]",
                   leg.min_interval_s);
  problems.Append("pilot", ProblemsOf(leg.pilot));
  return problems.Take();
}

}  // namespace

std::vector<std::string> FlightOptions::Problems() const {
  ProblemList problems;
  problems.Require(ParseUtcTime(start_time).has_value(),
                   "start_time",
                   "a time such as 2026-05-12T09:30:00, from 1970 to 2100",
                   start_time);
  problems.Require(!legs.empty(), "legs", "at least one", 0);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    problems.Append("legs[" + std::to_string(i) + ']', ProblemsOf(legs[i]));
  }
  return problems.Take();
}

}  // namespace plumb
