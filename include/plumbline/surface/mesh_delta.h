// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/image/features.h"

namespace plumb {

// A cube of space, of the side SurfaceOptions::block_side: floor(position / side) on each axis.
struct BlockId {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  friend bool operator==(const BlockId& a, const BlockId& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  friend bool operator!=(const BlockId& a, const BlockId& b) { return !(a == b); }
  friend bool operator<(const BlockId& a, const BlockId& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

// The name of a face, for as long as it is in the mesh: its landmarks, anticlockwise seen from
// outside, the smallest id first.
using FaceKey = std::array<LandmarkId, 3>;

struct MeshVertex {
  LandmarkId landmark;
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  Rgb color = {0, 0, 0};

  friend bool operator==(const MeshVertex& a, const MeshVertex& b) {
    return a.landmark == b.landmark && a.position_in_map == b.position_in_map && a.color == b.color;
  }
};

// All faces whose centroid lies in one cube. Two meshes are equal if their blocks are.
struct MeshBlock {
  BlockId id;
  std::vector<MeshVertex> vertices;                 // By landmark.
  std::vector<std::array<std::uint32_t, 3>> faces;  // Into `vertices`; ascending, as their keys.

  FaceKey KeyOf(std::size_t face_idx) const {
    const std::array<std::uint32_t, 3>& face = faces[face_idx];
    return {vertices[face[0]].landmark, vertices[face[1]].landmark, vertices[face[2]].landmark};
  }

  friend bool operator==(const MeshBlock& a, const MeshBlock& b) {
    return a.id == b.id && a.vertices == b.vertices && a.faces == b.faces;
  }
};

// All that changed in the mesh between two moments. Numbered from 1 without gaps; applying
// deltas in order to an empty mesh gives the mesh. A snapshot starts from the empty mesh.
struct MeshDelta {
  std::uint32_t sequence = 0;
  bool is_snapshot = false;        // Replaces everything known before.
  std::uint32_t map_sequence = 0;  // Of the last MapDelta that the mesh knows.

  // Each as a whole, ascending; one without faces is gone. A block is here if one of its faces came
  // or went, or one of its vertices moved or changed its colour.
  std::vector<MeshBlock> blocks;

  // Names that are new, and names that are gone; ascending. A face that only moved is in neither.
  std::vector<FaceKey> faces_added;
  std::vector<FaceKey> faces_removed;
};

}  // namespace plumb
