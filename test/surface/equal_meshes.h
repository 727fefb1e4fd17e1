// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "plumbline/surface/mesh_delta.h"

namespace plumb::test {

// To the last bit, but for the numbers of the deltas.
inline void ExpectSameMesh(const MeshDelta& a, const MeshDelta& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    ASSERT_TRUE(a.blocks[i] == b.blocks[i])
        << a.blocks[i].id.x << ' ' << a.blocks[i].id.y << ' ' << a.blocks[i].id.z;
  }
  ASSERT_EQ(a.faces_added, b.faces_added);
}

}  // namespace plumb::test
