// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/tetrahedra.h"

namespace plumb {

enum class RaySide { kTowardsCamera, kAwayFromCamera };

// The finite cell around `vertex` that the ray to the camera, or its extension behind the vertex,
// leads into; null if it leads out of the hull. Exact. A ray along a face or an edge goes to
// the cell with the smallest landmark ids of those it touches, so that the answer does not depend
// on where the search starts: at `hint`, a finite cell around the vertex.
Cell FindRayCell(const Triangulation& triangulation,
                 Vertex vertex,
                 const SurfaceKernel::Point_3& camera,
                 RaySide side,
                 Cell hint);

// The same by looking at all of `star`, the cells around the vertex.
Cell FindRayCellInStar(const Triangulation& triangulation,
                       Vertex vertex,
                       const SurfaceKernel::Point_3& camera,
                       RaySide side,
                       const std::vector<Cell>& star);

// Of the rays of one of a cell's vertices, as CellInfo has them.
struct RayCounts {
  std::uint16_t num_passing = 0;
  std::uint16_t num_crossing = 0;
  std::uint16_t num_behind = 0;
};

// The finite cells around a vertex, and what was counted in each before.
struct RayStar {
  std::vector<Cell> cells;
  std::vector<RayCounts> counts_before;

  // Whether another number is counted in the cell now.
  bool IsChanged(std::size_t cell, Vertex vertex) const;
};

// Counts the vertex's rays in the cells around it, `star`, in place of what was counted for this
// vertex before. Thread-safe for different vertices while the triangulation stays as it is.
void CastRays(const Triangulation& triangulation,
              Vertex vertex,
              const std::vector<SceneRay>& rays,
              RayStar* star);

}  // namespace plumb
