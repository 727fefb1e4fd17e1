// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

// docs/surface.md tells what each value was chosen by.
struct SurfaceOptions {
  // The energy (paper, section III.C). Whole numbers: sums of them are exact, so that the least cut
  // is the same however it was arrived at.
  int alpha_free = 128;  // For each ray that passes a cell labelled occupied.
  int alpha_occ = 96;    // For each ray that ends before a cell labelled free.

  // Between cells of unlike labels, through a face that a ray crosses first; times 0 to 2 by the
  // angles of the face. Each side of the face counts.
  int beta_vis = 36;

  // The same, through any other face.
  int beta_init = 72;

  // A landmark stands on a lattice of the pitch d / 2^bits, d being the distance of its nearest
  // camera, rounded down to a power of two. A move within the pitch changes no tetrahedra.
  int landmark_lattice_bits = 9;

  // The same for the camera of a ray, d being that of the ray's landmark: the ray is cast anew if
  // the camera's place changes.
  int camera_lattice_bits = 8;

  // The mesh shows landmarks on a lattice finer than that of the tetrahedra by so many bits, and
  // what moves within that is not sent again.
  int mesh_lattice_bits = 3;

  // Longest edge of a face that is kept, over the distance of the nearest camera; twice that for a
  // face whose corners one photo shows together.
  double max_edge_ratio = 0.05;

  // Connected sets of fewer faces are dropped: they hang on wrong matches.
  int min_island_faces = 30;

  // A landmark that only two photos show and that stands out of its neighbours by more, over the
  // distance of the nearest camera, hangs on a match that nothing confirms: its faces are dropped.
  double max_spike_ratio = 0.008;

  // Side of the blocks that the mesh is cut into, in the map's unit, which is seldom far from a
  // metre: the first two cameras are one unit apart.
  double block_side = 1.0;

  // Threads of one step; 0: one for each core. Does not change the result.
  int num_threads = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(SurfaceOptions& options, Visitor&& visit) {
  visit("alpha_free", options.alpha_free);
  visit("alpha_occ", options.alpha_occ);
  visit("beta_vis", options.beta_vis);
  visit("beta_init", options.beta_init);
  visit("landmark_lattice_bits", options.landmark_lattice_bits);
  visit("camera_lattice_bits", options.camera_lattice_bits);
  visit("mesh_lattice_bits", options.mesh_lattice_bits);
  visit("max_edge_ratio", options.max_edge_ratio);
  visit("min_island_faces", options.min_island_faces);
  visit("max_spike_ratio", options.max_spike_ratio);
  visit("block_side", options.block_side);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
