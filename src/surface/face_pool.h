// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "plumbline/surface/mesh_delta.h"
#include "surface/ray_scene.h"

namespace plumb {

using FaceIdx = std::uint32_t;
constexpr FaceIdx kNoFace = 0xFFFFFFFF;

// Corners of a face, anticlockwise seen from outside, the smallest landmark id first.
using FaceSlots = std::array<Slot, 3>;

constexpr std::uint32_t kNoFaceArc = 0xFFFFFFFF;

struct Face {
  FaceSlots slots = {kNoSlot, kNoSlot, kNoSlot};
  FaceKey key;
  std::uint32_t arc = kNoFaceArc;  // Slot of the cut that it lies at, on the occupied side.
  BlockId block;
  bool is_used = false;
  bool is_island = false;
  bool is_published = false;  // In the mesh that was last sent.
};

// The faces between free and occupied cells that rays support, each found by its arc, by its
// corners, and by its block. One whose cell is gone may be detached until it is known whether
// another cell has the same face.
class FacePool {
 public:
  // There must be none at the arc.
  FaceIdx Add(std::uint32_t arc, const FaceSlots& slots, const FaceKey& key, const BlockId& block);
  void Remove(FaceIdx face);
  void Detach(FaceIdx face);
  void Attach(FaceIdx face, std::uint32_t arc);
  void MoveTo(FaceIdx face, const BlockId& block);
  void SetIsland(FaceIdx face, bool is_island) { faces_[face].is_island = is_island; }
  void SetPublished(FaceIdx face, bool is_published) { faces_[face].is_published = is_published; }

  FaceIdx AtArc(std::uint32_t arc) const {
    return arc < face_of_arc_.size() ? face_of_arc_[arc] : kNoFace;
  }
  bool IsDetached(FaceIdx face) const {
    return faces_[face].is_used && faces_[face].arc == kNoFaceArc;
  }
  FaceIdx FindDetached(const FaceSlots& slots) const;  // kNoFace if there is none.
  const Face& operator[](FaceIdx face) const { return faces_[face]; }
  const std::vector<FaceIdx>& AroundSlot(Slot slot) const;
  const std::vector<FaceIdx>& InBlock(const BlockId& block) const;
  std::vector<BlockId> Blocks() const;  // Ascending.

  std::size_t size() const { return faces_.size() - unused_.size(); }
  std::size_t capacity() const { return faces_.size(); }

 private:
  struct BlockHash {
    std::size_t operator()(const BlockId& id) const {
      std::uint64_t hash = static_cast<std::uint32_t>(id.x);
      hash = (hash << 21) ^ (hash >> 43) ^ static_cast<std::uint32_t>(id.y);
      hash = (hash << 21) ^ (hash >> 43) ^ static_cast<std::uint32_t>(id.z);
      return static_cast<std::size_t>(hash * 0x9E3779B97F4A7C15ULL);
    }
  };

  void LeaveBlock(FaceIdx face);

  std::vector<Face> faces_;
  std::vector<FaceIdx> unused_;
  std::vector<FaceIdx> face_of_arc_;
  std::vector<std::vector<FaceIdx>> faces_of_slot_;
  std::unordered_map<BlockId, std::vector<FaceIdx>, BlockHash> faces_of_block_;
};

}  // namespace plumb
