// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/flight.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "plumbline/common/options.h"
#include "simulation/flight_path.h"
#include "simulation/random_numbers.h"
#include "simulation/utc_time.h"

namespace plumb {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;
constexpr double kBetweenLegs_s = 10.0;

// What the random numbers are for.
enum RandomUse : std::uint64_t { kPilotUse = 0x70696C6F74, kDriftUse = 0x6472696674 };

// A station with its time since the flight began and the planned velocity there.
struct TimedStation {
  Station station;
  double time_s = 0.0;
  Eigen::Vector3d velocity_in_world_m_s = Eigen::Vector3d::Zero();
};

Eigen::Quaterniond CamFromWorld(double yaw_rad, double pitch_rad) {
  Eigen::Matrix3d level_from_world;  // Camera x right, y down, z forward; the world's y forward.
  level_from_world << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Quaterniond turned =
      Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
      Eigen::Quaterniond(Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()));
  return Eigen::Quaterniond(level_from_world) * turned.conjugate();
}

// From station to station at the leg's speed, but not faster than the camera takes photos.
std::vector<TimedStation> PutInTime(const FlightLeg& leg,
                                    const std::vector<Station>& stations,
                                    double start_s) {
  std::vector<TimedStation> timed;
  for (const Station& station : stations) {
    double time_s = start_s;
    if (!timed.empty()) {
      const double way_m = (station.center_in_world - timed.back().station.center_in_world).norm();
      time_s = timed.back().time_s + std::max(way_m / leg.speed_m_s, leg.min_interval_s);
    }
    timed.push_back({station, time_s, Eigen::Vector3d::Zero()});
  }
  if (leg.stop_to_shoot) return timed;
  for (std::size_t i = 0; i < timed.size(); ++i) {
    const TimedStation& before = timed[i == 0 ? 0 : i - 1];
    const TimedStation& after = timed[std::min(i + 1, timed.size() - 1)];
    if (after.time_s == before.time_s) continue;
    timed[i].velocity_in_world_m_s =
        (after.station.center_in_world - before.station.center_in_world) /
        (after.time_s - before.time_s);
  }
  return timed;
}

// Wanders with periods of 11 to 60 photos; its standard deviation is 1 on each axis.
class Drift {
 public:
  explicit Drift(std::uint64_t seed) {
    RandomNumbers random(seed);
    for (Eigen::Vector3d& phase : phases_) {
      phase = 2.0 * kPi * Eigen::Vector3d(random.Uniform(), random.Uniform(), random.Uniform());
    }
  }
  Eigen::Vector3d At(std::size_t idx) const {
    constexpr double kPeriods[kNumWaves] = {11.0, 25.0, 60.0};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int wave = 0; wave < kNumWaves; ++wave) {
      const double angle = 2.0 * kPi * static_cast<double>(idx) / kPeriods[wave];
      sum += (phases_[wave].array() + angle).sin().matrix();
    }
    return std::sqrt(2.0 / kNumWaves) * sum;
  }

 private:
  static constexpr int kNumWaves = 3;
  Eigen::Vector3d phases_[kNumWaves];
};

// `num_runs` runs of `length` stations, one in each of as many equal parts of the leg, at a random
// place of it. Throws std::invalid_argument if they do not fit.
std::vector<std::size_t> DrawRuns(
    std::size_t num_stations, int num_runs, int length, const char* field, RandomNumbers* random) {
  std::vector<std::size_t> begins;
  if (num_runs == 0) return begins;
  const std::size_t part = num_stations / static_cast<std::size_t>(num_runs);
  const auto run = static_cast<std::size_t>(length);
  // A run keeps clear of both ends of its part, so that runs stay apart.
  if (part < run + 2) {
    throw std::invalid_argument(std::string("pilot.") + field + " of " + std::to_string(num_runs) +
                                " does not fit into " + std::to_string(num_stations) +
                                " photos; lower it or take more photos");
  }
  for (int i = 0; i < num_runs; ++i) {
    const double free = static_cast<double>(part - run - 1);
    begins.push_back(static_cast<std::size_t>(i) * part + 1 +
                     static_cast<std::size_t>(free * random->Uniform()));
  }
  return begins;
}

void TurnAway(const PilotOptions& pilot,
              RandomNumbers* random,
              std::vector<TimedStation>* stations) {
  const int length = pilot.wrong_turn_photos;
  for (const std::size_t begin :
       DrawRuns(stations->size(), pilot.num_wrong_turns, length, "num_wrong_turns", random)) {
    const double side = random->Uniform() < 0.5 ? -1.0 : 1.0;
    for (int i = 0; i < length; ++i) {
      const double share = std::sin(kPi * (i + 1.0) / (length + 1.0));
      (*stations)[begin + static_cast<std::size_t>(i)].station.yaw_rad +=
          side * share * pilot.wrong_turn_deg * kRadPerDeg;
    }
  }
}

void LeaveGaps(const PilotOptions& pilot,
               RandomNumbers* random,
               std::vector<TimedStation>* stations) {
  const std::vector<std::size_t> begins =
      DrawRuns(stations->size(), pilot.num_gaps, pilot.gap_photos, "num_gaps", random);
  for (auto begin = begins.rbegin(); begin != begins.rend(); ++begin) {
    const auto first = stations->begin() + static_cast<std::ptrdiff_t>(*begin);
    stations->erase(first, first + pilot.gap_photos);
  }
}

PlannedPhoto Fly(const FlightLeg& leg,
                 const TimedStation& timed,
                 const Eigen::Vector3d& drift,
                 RandomNumbers* random) {
  const PilotOptions& pilot = leg.pilot;
  PlannedPhoto photo;
  photo.row = leg.row;
  photo.distance_m = leg.kind == "waypoints" ? -timed.station.center_in_world.y() : leg.distance_m;
  const Eigen::Vector3d center = timed.station.center_in_world + pilot.drift_m * drift +
                                 random->Normal3(pilot.position_jitter_m);
  const Eigen::Vector3d turn = random->Normal3(pilot.attitude_jitter_deg * kRadPerDeg);
  const Eigen::Quaterniond jitter(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
  const Eigen::Quaterniond cam_from_world =
      jitter * CamFromWorld(timed.station.yaw_rad, timed.station.pitch_rad);
  photo.cam_from_world = Rigid3(cam_from_world, -(cam_from_world * center));
  photo.velocity_in_cam_m_s =
      cam_from_world * (timed.velocity_in_world_m_s + random->Normal3(pilot.sway_m_s));
  photo.turn_rate_in_cam_rad_s = random->Normal3(pilot.shake_deg_s * kRadPerDeg);
  return photo;
}

std::vector<TimedStation> PlanLeg(const FlightLeg& leg,
                                  const Camera& camera,
                                  const Building& building,
                                  double start_s,
                                  RandomNumbers* random) {
  const int num_spare = leg.pilot.num_gaps * leg.pilot.gap_photos;
  std::vector<TimedStation> stations =
      PutInTime(leg, PlanStations(leg, camera, building, num_spare), start_s);
  LeaveGaps(leg.pilot, random, &stations);
  TurnAway(leg.pilot, random, &stations);
  return stations;
}

std::string NameOf(std::size_t number, const std::string& row) {
  std::ostringstream name;
  name << std::setw(4) << std::setfill('0') << number << (row.empty() ? "" : "_") << row << ".jpg";
  return name.str();
}

}  // namespace

std::vector<PlannedPhoto> PlanFlight(const FlightOptions& options,
                                     const Camera& camera,
                                     const Building& building,
                                     std::uint64_t seed) {
  ThrowIfProblems("flight", options.Problems());
  const Timestamp start = *ParseUtcTime(options.start_time);
  std::vector<PlannedPhoto> photos;
  double time_s = 0.0;
  for (std::size_t leg_idx = 0; leg_idx < options.legs.size(); ++leg_idx) {
    const FlightLeg& leg = options.legs[leg_idx];
    RandomNumbers random(DeriveSeed(seed, kPilotUse, leg_idx));
    const Drift drift(DeriveSeed(seed, kDriftUse, leg_idx));
    try {
      const std::vector<TimedStation> stations =
          PlanLeg(leg, camera, building, time_s + kBetweenLegs_s, &random);
      for (std::size_t i = 0; i < stations.size(); ++i) {
        photos.push_back(Fly(leg, stations[i], drift.At(i), &random));
        time_s = stations[i].time_s;
        photos.back().exposure_time.ns = start.ns + std::llround(1e9 * time_s);
        photos.back().name = NameOf(photos.size(), leg.row);
      }
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("flight.legs[" + std::to_string(leg_idx) + "]: " + error.what());
    }
  }
  return photos;
}

}  // namespace plumb
