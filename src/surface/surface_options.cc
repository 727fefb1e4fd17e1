// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/surface_options.h"

#include "plumbline/common/options.h"

namespace plumb {
namespace {

// Of any weight; some 60 000 rays of a cell then still fit 32 bits.
constexpr int kMaxWeight = 1000;

}  // namespace

std::vector<std::string> SurfaceOptions::Problems() const {
  ProblemList problems;
  const auto require_weight = [&](const char* field, int weight) {
    problems.Require(weight >= 0 && weight <= kMaxWeight, field, "in [0, 1000]", weight);
  };
  require_weight("alpha_free", alpha_free);
  require_weight("alpha_occ", alpha_occ);
  require_weight("beta_vis", beta_vis);
  require_weight("beta_init", beta_init);
  problems.Require(landmark_lattice_bits >= 4 && landmark_lattice_bits <= 24,
                   "landmark_lattice_bits",
                   "in [4, 24]",
                   landmark_lattice_bits);
  problems.Require(camera_lattice_bits >= 4 && camera_lattice_bits <= 24,
                   "camera_lattice_bits",
                   "in [4, 24]",
                   camera_lattice_bits);
  problems.Require(mesh_lattice_bits >= 0 && mesh_lattice_bits <= 16,
                   "mesh_lattice_bits",
                   "in [0, 16]",
                   mesh_lattice_bits);
  problems.Require(max_edge_ratio > 0.0, "max_edge_ratio", "above 0", max_edge_ratio);
  problems.Require(min_island_faces >= 0, "min_island_faces", "at least 0", min_island_faces);
  problems.Require(max_spike_ratio > 0.0, "max_spike_ratio", "above 0", max_spike_ratio);
  problems.Require(block_side >= 0.01, "block_side", "at least 0.01", block_side);
  problems.Require(num_threads >= 0, "num_threads", "0 or more", num_threads);
  return problems.Take();
}

}  // namespace plumb
