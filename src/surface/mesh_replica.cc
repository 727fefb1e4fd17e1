// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/mesh_replica.h"

#include <algorithm>

namespace plumb {

bool MeshReplica::Apply(const MeshDelta& delta) {
  if (delta.is_snapshot) {
    blocks_.clear();
    num_faces_ = 0;
  } else if (delta.sequence != sequence_ + 1) {
    return false;
  }
  for (const MeshBlock& block : delta.blocks) Set(block);
  sequence_ = delta.sequence;
  map_sequence_ = delta.map_sequence;
  return true;
}

void MeshReplica::Set(const MeshBlock& block) {
  const auto it = blocks_.find(block.id);
  if (it != blocks_.end()) num_faces_ -= it->second.faces.size();
  num_faces_ += block.faces.size();
  if (!block.faces.empty()) {
    blocks_.insert_or_assign(block.id, block);
  } else if (it != blocks_.end()) {
    blocks_.erase(it);
  }
}

MeshDelta MeshReplica::Snapshot() const {
  MeshDelta snapshot;
  snapshot.sequence = sequence_;
  snapshot.is_snapshot = true;
  snapshot.map_sequence = map_sequence_;
  for (const auto& [id, block] : blocks_) {
    for (std::size_t i = 0; i < block.faces.size(); ++i) {
      snapshot.faces_added.push_back(block.KeyOf(i));
    }
    snapshot.blocks.push_back(block);
  }
  std::sort(snapshot.faces_added.begin(), snapshot.faces_added.end());
  return snapshot;
}

}  // namespace plumb
