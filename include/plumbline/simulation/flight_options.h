// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

// A place and a viewing direction before the main wall. Yaw 0 faces the wall, positive turns left
// seen from above; pitch is positive upwards.
struct Waypoint {
  double x_m = 0.0;
  double distance_m = 6.0;
  double z_m = 2.0;
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
};

template <typename Visitor>
void VisitFields(Waypoint& waypoint, Visitor&& visit) {
  visit("x_m", waypoint.x_m);
  visit("distance_m", waypoint.distance_m);
  visit("z_m", waypoint.z_m);
  visit("yaw_deg", waypoint.yaw_deg);
  visit("pitch_deg", waypoint.pitch_deg);
}

// How far the pilot and the wind lead away from the plan.
struct PilotOptions {
  double position_jitter_m = 0.05;  // Standard deviations, each photo, each axis.
  double attitude_jitter_deg = 1.0;
  double drift_m = 0.0;  // Slow wandering over tens of photos, each axis.
  int num_gaps = 0;      // So many times gap_photos photos in a row are missing.
  int gap_photos = 3;
  int num_wrong_turns = 0;  // So many times the camera turns away and comes back.
  int wrong_turn_photos = 4;
  double wrong_turn_deg = 70.0;
  double sway_m_s = 0.05;  // Standard deviations of the motion that blurs.
  double shake_deg_s = 2.0;
};

template <typename Visitor>
void VisitFields(PilotOptions& options, Visitor&& visit) {
  visit("position_jitter_m", options.position_jitter_m);
  visit("attitude_jitter_deg", options.attitude_jitter_deg);
  visit("drift_m", options.drift_m);
  visit("num_gaps", options.num_gaps);
  visit("gap_photos", options.gap_photos);
  visit("num_wrong_turns", options.num_wrong_turns);
  visit("wrong_turn_photos", options.wrong_turn_photos);
  visit("wrong_turn_deg", options.wrong_turn_deg);
  visit("sway_m_s", options.sway_m_s);
  visit("shake_deg_s", options.shake_deg_s);
}

// One part of a flight.
struct FlightLeg {
  // rows: back and forth over a part of the main wall, row above row; orbit: around the building,
  // circle above circle; hover: turning on the spot; waypoints: from one to the next.
  std::string kind = "rows";
  std::string row;  // Goes into the photos' names, e.g. 4m; empty: none.

  double distance_m = 6.0;  // From the wall; an orbit's from the building.
  double x_min_m = 0.0;     // The part of the wall to cover (hover: its middle is looked at).
  double x_max_m = 10.0;
  double z_min_m = 0.0;
  double z_max_m = 8.0;
  double forward_overlap = 0.75;  // Of neighbours in a row, at least; share of the photo.
  double side_overlap = 0.6;      // Of neighbouring rows, at least.
  int num_photos = 0;             // Exactly so many; 0: as the overlap asks for.
  double yaw_deg = 0.0;           // Oblique: the camera stands aside and looks at the same place.
  double pitch_deg = 0.0;
  double sweep_deg = 60.0;     // Hover: from half of it left to half of it right.
  double max_turn_deg = 10.0;  // Orbit: from photo to photo.
  std::vector<Waypoint> waypoints;

  double speed_m_s = 1.5;
  double min_interval_s = 1.0;  // The camera takes no photos faster.
  bool stop_to_shoot = false;
  PilotOptions pilot;
};

template <typename Visitor>
void VisitFields(FlightLeg& leg, Visitor&& visit) {
  visit("kind", leg.kind);
  visit("row", leg.row);
  visit("distance_m", leg.distance_m);
  visit("x_min_m", leg.x_min_m);
  visit("x_max_m", leg.x_max_m);
  visit("z_min_m", leg.z_min_m);
  visit("z_max_m", leg.z_max_m);
  visit("forward_overlap", leg.forward_overlap);
  visit("side_overlap", leg.side_overlap);
  visit("num_photos", leg.num_photos);
  visit("yaw_deg", leg.yaw_deg);
  visit("pitch_deg", leg.pitch_deg);
  visit("sweep_deg", leg.sweep_deg);
  visit("max_turn_deg", leg.max_turn_deg);
  visit("waypoints", leg.waypoints);
  visit("speed_m_s", leg.speed_m_s);
  visit("min_interval_s", leg.min_interval_s);
  visit("stop_to_shoot", leg.stop_to_shoot);
  visit("pilot", leg.pilot);
}

struct FlightOptions {
  std::string start_time = "2026-05-12T09:30:00";  // UTC.
  std::vector<FlightLeg> legs;                     // Flown one after the other.

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(FlightOptions& options, Visitor&& visit) {
  visit("start_time", options.start_time);
  visit("legs", options.legs);
}

}  // namespace plumb
