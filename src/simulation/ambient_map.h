// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/patch.h"
#include "simulation/ray_scene.h"

namespace plumb::internal {

// What falls on a facet from all around, on a grid over its texture coordinates.
class AmbientMap {
 public:
  struct Value {
    float seen = 1.0F;     // Share of the light of sky and ground that arrives.
    float run_off = 0.0F;  // 0..1: how much dirty water runs down from a ledge above.
  };

  // Of a facet that nothing is near to.
  AmbientMap() : AmbientMap({0.0F, 0.0F}, {1.0F, 1.0F}, 2, 2) {}

  // Columns and rows, at least 2 each, from corner to corner [m].
  AmbientMap(const Eigen::Vector2f& low, const Eigen::Vector2f& high, int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  Eigen::Vector2f GridPoint(int column, int row) const;
  Value& Cell(int column, int row) { return values_[row * columns_ + column]; }

  // Bilinear; beyond the grid its border goes on.
  Value At(float u, float v) const;

 private:
  Eigen::Vector2f low_;
  Eigen::Vector2f cells_per_m_;
  int columns_, rows_;
  std::vector<Value> values_;
};

// One map for each facet, by casting rays from the grid points. Deterministic.
std::vector<AmbientMap> BakeAmbientMaps(const PatchWorld& world,
                                        const RayScene& scene,
                                        int num_facets);

}  // namespace plumb::internal
