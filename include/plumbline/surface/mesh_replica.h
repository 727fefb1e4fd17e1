// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "plumbline/surface/mesh_delta.h"

namespace plumb {

// The mesh as its deltas tell it, for whoever stands downstream of the mesher. Not thread-safe.
class MeshReplica {
 public:
  // False, and nothing changed, if the delta is no snapshot and not the next in number: ask
  // for a snapshot.
  bool Apply(const MeshDelta& delta);

  // The whole as one delta, under the number of the last one applied.
  MeshDelta Snapshot() const;

  std::uint32_t sequence() const { return sequence_; }
  std::uint32_t map_sequence() const { return map_sequence_; }
  const std::map<BlockId, MeshBlock>& blocks() const { return blocks_; }
  std::size_t num_faces() const { return num_faces_; }

 private:
  void Set(const MeshBlock& block);

  std::uint32_t sequence_ = 0;
  std::uint32_t map_sequence_ = 0;
  std::size_t num_faces_ = 0;
  std::map<BlockId, MeshBlock> blocks_;
};

}  // namespace plumb
