// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/mesh_builder.h"

namespace plumb {

// How many elements of about that size fill a length, at least 1; the same for lengths that
// differ by rounding alone.
int FittedCount(double length_m, double size_m);

// A moulding's cross section: (across, out) [m]. `across` never falls along the list; the first
// and the last point lie on the surface that carries the moulding, or behind it.
using Profile = std::vector<Eigen::Vector2d>;

// Where a sweep's cross section stands: a profile point is origin + across * a + out * o. Mitred
// sections have axes longer than 1.
struct SweepSection {
  Eigen::Vector3d origin;
  Eigen::Vector3d across;
  Eigen::Vector3d out;
};

// Sections along a path (x, z) on a wall, local y = plane_y_m; `across` points to the left of
// the path's direction as seen from outside (local -y), `out` away from the wall.
std::vector<SweepSection> WallPath(const std::vector<Eigen::Vector2d>& path,
                                   double plane_y_m,
                                   bool is_loop = false);

// Sections along a level path (x, y) at height z_m; `across` is up, `out` to the path's right.
std::vector<SweepSection> LevelPath(const std::vector<Eigen::Vector2d>& path,
                                    double z_m,
                                    bool is_loop = false);

enum class SweepEnds { kOpen, kCapped, kLoop };

// The profile drawn along the sections; caps close the ends back to the first point's out.
void AddSweep(MeshBuilder& builder,
              const Profile& profile,
              const std::vector<SweepSection>& sections,
              std::uint32_t material,
              SweepEnds ends);

// A straight moulding on the wall plane y = plane_y_m, from x0 to x1, `across` up from z, capped.
void AddMoulding(MeshBuilder& builder,
                 const Profile& profile,
                 double x0,
                 double x1,
                 double z,
                 std::uint32_t material,
                 double plane_y_m = 0.0);

// Which faces of a box are left out, because nobody can see them.
struct BoxFaces {
  bool front = true;   // -y
  bool back = false;   // +y
  bool sides = true;   // -x, +x
  bool bottom = true;  // -z
  bool top = true;     // +z
};

void AddBox(MeshBuilder& builder,
            const Eigen::Vector3d& low,
            const Eigen::Vector3d& high,
            std::uint32_t material,
            const BoxFaces& faces = {});

// A block on a wall without its back; the front's edges are cut off at 45 degrees.
void AddBlock(MeshBuilder& builder,
              const Eigen::Vector3d& low,
              const Eigen::Vector3d& high,
              double bevel_m,
              std::uint32_t material);

// The same with a bevel of its own on the left and on the right; 0: it goes on in the next block.
void AddBlock(MeshBuilder& builder,
              const Eigen::Vector3d& low,
              const Eigen::Vector3d& high,
              double bevel_m,
              double left_bevel_m,
              double right_bevel_m,
              std::uint32_t material);

// A surface of revolution about the upright line through `foot`; outline of (radius, height)
// upwards, open at both ends unless its radius is 0 there.
void AddRevolution(MeshBuilder& builder,
                   const std::vector<Eigen::Vector2d>& outline,
                   const Eigen::Vector3d& foot,
                   int num_sides,
                   std::uint32_t material);

// A round bar along a path, with plane ends.
void AddTube(MeshBuilder& builder,
             const std::vector<Eigen::Vector3d>& path,
             double radius_m,
             int num_sides,
             std::uint32_t material);

}  // namespace plumb
