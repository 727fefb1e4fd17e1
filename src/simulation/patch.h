// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plumbline/simulation/world.h"
#include "simulation/ray_scene.h"

namespace plumb::internal {

// A plane piece of one facet, or a plate: what the renderer shades as one.
struct Patch {
  Eigen::Vector3d normal;  // Outward, unit length.
  double offset;           // normal . point [m].
  // Texture coordinates: (u, v) = (u_axis, v_axis) . (point - texture_origin) [m].
  Eigen::Vector3d texture_origin;
  Eigen::Vector3d u_axis, v_axis;
  std::uint32_t texture_seed = 0;
  int facet = -1;  // Into World::facets; -1 for a plate.
  int plate = -1;  // Into World::plates; -1 for a facet.
};

// The world cut into patches; triangle i of the ray scene belongs to patch_of_triangle[i].
// Triangles of plates, two each, follow the world's own.
struct PatchWorld {
  std::vector<Triangle3> triangles;
  std::vector<int> patch_of_triangle;
  std::vector<Patch> patches;
};

// Throws std::invalid_argument if an index is out of range or a number is not finite.
PatchWorld CutIntoPatches(const World& world);

}  // namespace plumb::internal
