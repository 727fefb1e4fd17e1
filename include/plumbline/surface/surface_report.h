// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plumbline/common/ids.h"

namespace plumb {

// Something in a MapDelta that the surface cannot use. It is left out for as long as it stays
// so, and all else is used.
struct SurfaceProblem {
  enum class Kind {
    kLandmarkNotFinite,  // NaN, infinite, or too far off to be squared.
    kLandmarkDoubled,    // Exactly where `other` is; both count as one vertex.
    kViewNotFinite,
    kCameraOnLandmark,  // A ray without a direction.
    kUnknownLandmark,   // Named by an observation, but not in the map.
    kUnknownView,
  };

  Kind kind = Kind::kLandmarkNotFinite;
  LandmarkId landmark;  // Invalid where the problem is a view's.
  LandmarkId other;     // Of kLandmarkDoubled.
  PhotoId photo;        // Invalid where the problem is a landmark's.
};

// A sentence that names the offending item.
std::string Describe(const SurfaceProblem& problem);

// What one MapDelta did to the surface.
struct SurfaceReport {
  std::uint32_t map_sequence = 0;

  // What it asked for, and how much of it mattered: what moved within its place on the lattice does
  // not (SurfaceOptions::landmark_lattice_bits).
  std::size_t num_landmarks_added = 0;
  std::size_t num_landmarks_removed = 0;
  std::size_t num_landmarks_moved = 0;
  std::size_t num_landmarks_reinserted = 0;
  std::size_t num_views_moved = 0;
  std::size_t num_views_recast = 0;
  std::size_t num_rays_added = 0;
  std::size_t num_rays_removed = 0;

  // What was done for it.
  std::size_t num_rays_cast = 0;
  std::size_t num_cells_changed = 0;  // Came into being, or were weighed anew.
  std::size_t num_labels_changed = 0;
  std::size_t num_faces_checked = 0;
  bool is_rebuilt = false;  // From nothing, because most of the landmarks moved.

  // What there is now.
  std::size_t num_vertices = 0;
  std::size_t num_cells = 0;  // Finite ones.
  std::size_t num_rays = 0;
  std::size_t num_faces = 0;

  // Wall-clock seconds of the stages.
  double scene_s = 0.0;
  double tetrahedra_s = 0.0;
  double weights_s = 0.0;
  double cut_s = 0.0;
  double mesh_s = 0.0;

  std::vector<SurfaceProblem> problems;  // That this delta brought.
};

}  // namespace plumb
