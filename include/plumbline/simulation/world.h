// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/material.h"

namespace plumb {

// The simulated world is metric: x along the facade to the right as seen from outside,
// y into the building, z up [m]. The facade's main wall lies in the plane y = 0, its lower left
// corner at the origin; outside is y < 0. As ENU: x east, y north, z up.

// What a set of triangles of one plane (or one gently curved piece) shares. The frame gives
// the texture coordinates: (u, v) = (u_axis, v_axis) . (point - origin) [m].
struct Facet {
  Eigen::Vector3d origin_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d u_axis = Eigen::Vector3d::UnitX();  // Unit length.
  Eigen::Vector3d v_axis = Eigen::Vector3d::UnitZ();
  std::uint32_t material = 0;  // Into World::materials.
  // Where repeated elements are wanted: all facets with the same copy_of show the same
  // texture at the same (u, v); -1: detail is unique, taken from the point in the world.
  int copy_of = -1;
  bool is_main_wall = false;  // Part of the plane y = 0 that is truly flat.
};

// Triangle: vertices anticlockwise seen from outside; facet into World::facets.
struct WorldTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::uint32_t facet = 0;
};

// A square plate with a picture, for a coded marker or a test pattern. The plate's frame: origin in
// its centre, x right, y down (as the picture's), z into the plate. It stands a millimetre or more
// off what carries it: of two surfaces in one place a ray meets either.
struct Plate {
  int id = -1;  // Of the coded marker, or the place's number.
  Rigid3 world_from_plate;
  double side_m = 0.5;
  std::string picture;  // Into World::pictures; empty: plain white.
};

// Grey picture of reflectances 0..255, row major; stretched over the plate's side.
struct PlatePicture {
  std::string name;
  int side_px = 0;
  std::vector<std::uint8_t> pixels;  // side_px * side_px.
};

struct World {
  std::vector<Eigen::Vector3d> vertices_in_world;
  std::vector<WorldTriangle> triangles;  // Without the plates.
  std::vector<Facet> facets;
  std::vector<Material> materials;
  std::vector<Plate> plates;
  std::vector<PlatePicture> pictures;
  std::uint32_t seed = 0;  // Of all textures.
};

}  // namespace plumb
