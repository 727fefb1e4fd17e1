// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "common/embree_handle.h"
#include "plumbline/surface/mesh_delta.h"

namespace plumb::internal {

// The faces of a mesh as obstacles (Embree). Each block has a tree of its own: a change costs what
// the changed blocks hold. Embree computes in float, and no ray slips through an edge that two
// faces share; that a face does not hide itself or a neighbour behind it is told in double. Casting
// is thread-safe while nothing changes.
class Occluders {
 public:
  Occluders();
  ~Occluders();
  Occluders(const Occluders&) = delete;
  Occluders& operator=(const Occluders&) = delete;

  // `block` must stay where it is, unchanged, until it is set again or removed. Faces with a corner
  // that is not finite hide nothing.
  void Set(const MeshBlock& block);
  void Remove(const BlockId& id);

  // After changes, before casting.
  void Commit();

  // For each of `face_idxs` of a block: 1 if a face other than itself lies between its centre and
  // the eye, else 0.
  void FindHidden(const MeshBlock& block,
                  const std::vector<Eigen::Vector3d>& centers_in_map,
                  const std::vector<std::uint32_t>& face_idxs,
                  const Eigen::Vector3d& eye_in_map,
                  std::vector<char>* is_hidden) const;

 private:
  EmbreeDevice device_;
  EmbreeScene scene_;
  std::map<BlockId, unsigned> geometry_of_block_;
};

}  // namespace plumb::internal
