// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "plumbline/surface/mesh_delta.h"

namespace plumb::test {

inline bool IsSameBlock(const MeshBlock& a, const MeshBlock& b) {
  if (a.id != b.id || a.faces != b.faces || a.vertices.size() != b.vertices.size()) return false;
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    if (a.vertices[i].landmark != b.vertices[i].landmark ||
        a.vertices[i].position_in_map != b.vertices[i].position_in_map ||
        a.vertices[i].color != b.vertices[i].color) {
      return false;
    }
  }
  return true;
}

// To the last bit, but for the numbers of the deltas.
inline void ExpectSameMesh(const MeshDelta& a, const MeshDelta& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    ASSERT_TRUE(IsSameBlock(a.blocks[i], b.blocks[i]))
        << a.blocks[i].id.x << ' ' << a.blocks[i].id.y << ' ' << a.blocks[i].id.z;
  }
  ASSERT_EQ(a.faces_added, b.faces_added);
}

}  // namespace plumb::test
