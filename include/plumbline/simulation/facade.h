// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/simulation/world.h"

namespace plumb {

// A building's facade, with ground and side walls, in the world's frame (world.h).
struct FacadeOptions {
  double width_m = 50.0;
  double height_m = 30.0;  // To the roof's edge.
  double depth_m = 12.0;   // Of the side walls, and of the building where it is closed.
  double plinth_height_m = 1.2;
  int num_storeys = 7;
  double bay_width_m = 3.6;  // From window axis to window axis; fitted to the width.
  double window_width_m = 1.3;
  double window_height_m = 2.1;
  double reveal_depth_m = 0.18;
  // Share of bays with a balcony, 0..1, drawn by the seed.
  double balcony_share = 0.15;
  int num_doors = 2;
  int num_downpipes = 3;
  double cornice_out_m = 0.7;  // How far the main cornice stands out of the wall.
  // Plates with coded markers for control points, their IDs from 0 on, spread over the main wall,
  // or over all four where it is closed.
  int num_targets = 17;
  double target_diameter_m = 0.5;  // Of the marker; the plate holds its quiet zone as well.
  bool closed = false;             // All four sides have bays: a building to fly around.
  // 0: each window, sill, stone is unique; 1: all are exact copies, detail included.
  double repetition = 0.0;
  // Share of the main wall's storeys that are plain painted, nearly without texture, 0..1.
  double textureless_share = 0.0;
  double detail = 1.0;  // Scales the detail of every material.
  std::uint32_t seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(FacadeOptions& options, Visitor&& visit) {
  visit("width_m", options.width_m);
  visit("height_m", options.height_m);
  visit("depth_m", options.depth_m);
  visit("plinth_height_m", options.plinth_height_m);
  visit("num_storeys", options.num_storeys);
  visit("bay_width_m", options.bay_width_m);
  visit("window_width_m", options.window_width_m);
  visit("window_height_m", options.window_height_m);
  visit("reveal_depth_m", options.reveal_depth_m);
  visit("balcony_share", options.balcony_share);
  visit("num_doors", options.num_doors);
  visit("num_downpipes", options.num_downpipes);
  visit("cornice_out_m", options.cornice_out_m);
  visit("num_targets", options.num_targets);
  visit("target_diameter_m", options.target_diameter_m);
  visit("closed", options.closed);
  visit("repetition", options.repetition);
  visit("textureless_share", options.textureless_share);
  visit("detail", options.detail);
  visit("seed", options.seed);
}

// Throws std::invalid_argument listing options.Problems(). Deterministic.
World BuildFacade(const FacadeOptions& options);

}  // namespace plumb
