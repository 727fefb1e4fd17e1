// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "common/embree_handle.h"
#include "plumbline/surface/mesh_delta.h"

namespace plumb::internal {

// From the centre of a face to an eye.
struct SightLine {
  std::uint32_t face = 0;
  const Eigen::Vector3d* center_in_map = nullptr;
  const Eigen::Vector3d* eye_in_map = nullptr;
};

// The faces of a mesh as obstacles (Embree). Each block has a tree of its own, and blocks hang in
// the trees of regions of four by four by four: a change costs what the changed blocks and their
// regions hold. Embree computes in float, and no ray slips through an edge that two faces share;
// that a face does not hide itself or a neighbour behind it is told in double. Casting is
// thread-safe while nothing changes.
class Occluders {
 public:
  Occluders();
  ~Occluders();
  Occluders(const Occluders&) = delete;
  Occluders& operator=(const Occluders&) = delete;

  // Each block must stay where it is, unchanged, until it is set again or removed. Faces with a
  // corner that is not finite hide nothing.
  void Set(const std::vector<const MeshBlock*>& blocks, int num_threads);
  void Remove(const BlockId& id);

  // After changes, before casting: first each changed region, at the same time if that suits, then
  // the whole.
  const std::set<BlockId>& changed_regions() const { return changed_regions_; }
  void CommitRegion(const BlockId& id) const;
  void Commit();

  // For each line of a block: 1 if a face other than its own lies between, else 0. Quick if lines
  // that follow each other begin near each other.
  std::vector<char> FindHidden(const MeshBlock& block, const std::vector<SightLine>& lines) const;

 private:
  struct Region {
    EmbreeScene scene;
    EmbreeGeometry instance;  // Of `scene` in the scene of all.
    unsigned instance_id = 0;
    std::map<BlockId, unsigned> geometry_of_block;
  };

  static BlockId RegionOf(const BlockId& block);
  void Attach(const BlockId& block, const EmbreeGeometry& geometry);
  Region* EnsureRegion(const BlockId& id);

  EmbreeDevice device_;
  EmbreeScene scene_;
  std::map<BlockId, Region> regions_;
  std::set<BlockId> changed_regions_;
};

}  // namespace plumb::internal
