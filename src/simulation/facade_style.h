// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plumbline/simulation/facade.h"
#include "plumbline/simulation/world.h"

namespace plumb {

// Indices into World::materials.
struct Palette {
  std::uint32_t plaster = 0;
  std::uint32_t brick = 0;
  std::uint32_t ashlar = 0;
  std::uint32_t plinth_stone = 0;
  std::uint32_t trim = 0;    // Mouldings, surrounds.
  std::uint32_t reveal = 0;  // Plaster inside the openings.
  std::uint32_t plain = 0;   // Painted, nearly without texture.
  std::uint32_t frame = 0;   // Painted wood.
  std::uint32_t shutter = 0;
  std::uint32_t door = 0;
  std::array<std::uint32_t, 3> panes{};  // Dark, half light, behind curtains.
  std::uint32_t blind = 0;
  std::uint32_t iron = 0;
  std::uint32_t zinc = 0;
  std::uint32_t roof_tiles = 0;
  std::uint32_t pavement = 0;
  std::uint32_t kerb = 0;
  std::uint32_t grass = 0;
  std::uint32_t asphalt = 0;
};

// Adds the facade's materials to the world, colours drawn by the seed.
Palette AddPalette(World& world, const FacadeOptions& options);

enum class HoodKind { kNone, kStraight, kTriangular, kSegmental };

// How the windows of a storey are dressed.
struct WindowLook {
  double surround_width_m = 0.16;
  double surround_out_m = 0.05;
  HoodKind hood = HoodKind::kNone;
  HoodKind alternate_hood = HoodKind::kNone;  // Of every other bay.
  bool has_keystone = false;
  bool has_apron = false;
  bool has_shutters = false;
  bool has_transom = true;
  int num_glazing_bars = 1;  // Across each casement.
};

enum class WallKind { kRusticated, kBrick, kPlaster, kPlain };

struct StoreyStyle {
  int id = 0;  // Storeys with the same id look the same.
  WallKind wall = WallKind::kPlaster;
  WindowLook look;
  double course_height_m = 0.3;  // Of the string course at its foot; 0: none.
  double course_out_m = 0.1;
};

// From the ground upwards, drawn by the seed.
std::vector<StoreyStyle> DrawStoreyStyles(const FacadeOptions& options);

}  // namespace plumb
