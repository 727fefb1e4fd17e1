// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/patch.h"
#include "simulation/ray_scene.h"

namespace plumb::internal {

// What falls on a facet from all around, baked on a grid over its texture coordinates.
class AmbientMap {
 public:
  struct Value {
    float seen = 1.0F;     // Share of the half sphere before the surface that is open.
    float run_off = 0.0F;  // 0..1: how much dirty water runs down from a ledge above.
  };

  // Of a facet nothing hides.
  AmbientMap() = default;

  // Bilinear; beyond the grid its border goes on.
  Value At(float u, float v) const;

  friend std::vector<AmbientMap> BakeAmbientMaps(const PatchWorld& world,
                                                 const RayScene& scene,
                                                 int num_facets,
                                                 int num_threads);

 private:
  float u0_ = 0.0F, v0_ = 0.0F;  // Of the first grid point [m].
  float cells_per_m_u_ = 0.0F, cells_per_m_v_ = 0.0F;
  int columns_ = 1, rows_ = 1;
  std::vector<Value> values_{Value()};
};

// One map for each facet, by casting rays from the grid points. Deterministic.
std::vector<AmbientMap> BakeAmbientMaps(const PatchWorld& world,
                                        const RayScene& scene,
                                        int num_facets,
                                        int num_threads);

}  // namespace plumb::internal
