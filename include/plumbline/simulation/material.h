// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace plumb {

// How a surface is patterned; each pattern is procedural, band-limited to the pixel that sees it.
enum class Pattern { kPlaster, kBrick, kAshlar, kWood, kGlass, kMetal, kRoofTiles, kGround };

// A surface's looks. Reflectances are linear, per colour channel R, G, B, 0..1.
struct Material {
  Pattern pattern = Pattern::kPlaster;
  Eigen::Vector3f reflectance{0.55F, 0.5F, 0.42F};
  // Standard deviation of the unique detail, as a share of the reflectance; 0: plain colour.
  // It is spread over the octaves from coarsest_detail_m down to finest_detail_m.
  float detail = 0.12F;
  float coarsest_detail_m = 2.0F;
  float finest_detail_m = 0.001F;
  // Bricks, stones, boards, tiles: size of one element and the joint between two [m].
  Eigen::Vector2f element_m{0.25F, 0.08F};
  float joint_m = 0.01F;
  float element_contrast = 0.1F;  // Standard deviation of the elements' own reflectances.
  float specular = 0.0F;          // Share mirrored (glass: the sky and what stands opposite).
};

}  // namespace plumb
