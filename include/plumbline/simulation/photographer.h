// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plumbline/simulation/flight.h"
#include "plumbline/simulation/renderer.h"
#include "plumbline/simulation/scenario.h"
#include "plumbline/simulation/world.h"

namespace plumb {

// Flies a scenario and takes its photos. Thread-safe: const methods hold no mutable state.
class Photographer {
 public:
  // Builds the world and plans the flight. Throws std::invalid_argument listing
  // scenario.Problems(), or naming a leg that is impossible or comes too near to the building, with
  // the cure; std::runtime_error for the lens's file.
  explicit Photographer(const Scenario& scenario);

  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }
  const Renderer& renderer() const { return renderer_; }
  const Camera& camera() const { return camera_; }
  const std::vector<PlannedPhoto>& photos() const { return photos_; }
  const std::vector<TelemetrySample>& telemetry() const { return telemetry_; }

  // Where the MAV believes that it took a photo.
  const std::optional<GeodeticPosition>& MeasuredPosition(std::size_t idx) const;

  // The file that the camera leaves. The same whatever the number of threads (0: all cores).
  std::vector<std::uint8_t> Take(std::size_t idx, int num_threads) const;

 private:
  double SceneDistance(const PlannedPhoto& photo) const;

  Scenario scenario_;
  Camera camera_;
  World world_;
  Renderer renderer_;
  std::vector<PlannedPhoto> photos_;
  std::vector<TelemetrySample> telemetry_;
  std::vector<std::size_t> sample_of_photo_;  // Into telemetry_.
};

}  // namespace plumb
