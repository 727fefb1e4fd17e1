// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/cell_weights.h"

#include <algorithm>
#include <numeric>

#include "surface/sphere_angles.h"

namespace plumb {
namespace {

std::int32_t SideWeight(const SurfaceOptions& options, Cell cell, int i) {
  const bool is_crossed = cell->info().num_crossing[static_cast<std::size_t>(i)] > 0;
  return is_crossed ? options.beta_vis : options.beta_init;
}

// Towards an infinite cell there is no sphere, and it is as if it met the face at no angle.
std::int32_t SphereCosine(Cell cell, int i) {
  return cell->info().node == kNoCutNode ? kCosineUnit
                                         : cell->info().sphere_cosines[static_cast<std::size_t>(i)];
}

std::int32_t Sum(const std::array<std::uint16_t, 4>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

// Whether beyond face `i` the world ends, and rays leave it there.
bool IsOpenHull(const Triangulation& triangulation, Cell cell, int i) {
  return cell->info().num_crossing[static_cast<std::size_t>(i)] > 0 &&
         triangulation.is_infinite(cell->neighbor(i));
}

}  // namespace

std::int32_t FaceWeightOf(const SurfaceOptions& options, Cell cell, int i) {
  const Cell neighbor = cell->neighbor(i);
  const int mirrored = neighbor->index(cell);
  const std::int32_t sides = SideWeight(options, cell, i) + SideWeight(options, neighbor, mirrored);
  const std::int32_t worst = std::min(SphereCosine(cell, i), SphereCosine(neighbor, mirrored));
  return sides * (kCosineUnit - worst) / kCosineUnit;
}

std::int32_t TerminalOf(const SurfaceOptions& options,
                        const Triangulation& triangulation,
                        Cell cell) {
  const CellInfo& info = cell->info();
  std::int32_t terminal =
      options.alpha_free * Sum(info.num_passing) - options.alpha_occ * Sum(info.num_behind);
  for (int i = 0; i < 4; ++i) {
    if (IsOpenHull(triangulation, cell, i)) terminal += FaceWeightOf(options, cell, i);
  }
  return terminal;
}

std::int64_t EnergyOf(const SurfaceOptions& options,
                      const Triangulation& triangulation,
                      const DynamicCut& cut) {
  std::int64_t energy = 0;
  if (triangulation.dimension() < 3) return energy;
  for (const Cell cell : triangulation.finite_cell_handles()) {
    const bool is_free = IsFree(cut, cell);
    energy += is_free ? options.alpha_occ * Sum(cell->info().num_behind)
                      : options.alpha_free * Sum(cell->info().num_passing);
    if (is_free) continue;
    for (int i = 0; i < 4; ++i) {
      const bool is_hull = triangulation.is_infinite(cell->neighbor(i));
      if (is_hull && !IsOpenHull(triangulation, cell, i)) continue;
      if (IsFree(cut, cell->neighbor(i))) energy += FaceWeightOf(options, cell, i);
    }
  }
  return energy;
}

}  // namespace plumb
