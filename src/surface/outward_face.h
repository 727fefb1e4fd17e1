// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "surface/face_pool.h"
#include "surface/tetrahedra.h"

namespace plumb {

// Corners of the face opposite to corner `i` of a finite cell, anticlockwise seen from outside the
// cell, the smallest landmark id first.
inline FaceSlots OutwardFace(Cell cell, int i) {
  // Cells are positively oriented.
  constexpr std::array<std::array<int, 3>, 4> kOutward = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  FaceSlots slots;
  std::array<LandmarkId, 3> ids;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexInfo& info = cell->vertex(kOutward[static_cast<std::size_t>(i)][k])->info();
    slots[k] = info.slot;
    ids[k] = info.id;
  }
  const auto smallest = std::min_element(ids.begin(), ids.end()) - ids.begin();
  std::rotate(slots.begin(), slots.begin() + smallest, slots.end());
  return slots;
}

}  // namespace plumb
