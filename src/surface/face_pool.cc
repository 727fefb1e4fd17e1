// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_pool.h"

#include <algorithm>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

void EraseFrom(std::vector<FaceIdx>* faces, FaceIdx face) {
  const auto it = std::find(faces->begin(), faces->end(), face);
  PLUMB_CHECK(it != faces->end());
  *it = faces->back();
  faces->pop_back();
}

const std::vector<FaceIdx>& NoFaces() {
  static const std::vector<FaceIdx> no_faces;
  return no_faces;
}

}  // namespace

FaceIdx FacePool::Add(std::uint32_t arc,
                      const FaceSlots& slots,
                      const FaceKey& key,
                      const BlockId& block) {
  PLUMB_CHECK_EQ(AtArc(arc), kNoFace);
  FaceIdx face = static_cast<FaceIdx>(faces_.size());
  if (unused_.empty()) {
    faces_.emplace_back();
  } else {
    face = unused_.back();
    unused_.pop_back();
  }
  faces_[face] = Face{slots, key, kNoFaceArc, block, /*is_used=*/true};
  Attach(face, arc);
  for (const Slot slot : slots) {
    if (faces_of_slot_.size() <= slot) faces_of_slot_.resize(slot + 1);
    faces_of_slot_[slot].push_back(face);
  }
  faces_of_block_[block].push_back(face);
  return face;
}

void FacePool::Remove(FaceIdx face) {
  Face& gone = faces_[face];
  PLUMB_CHECK(gone.is_used);
  if (!IsDetached(face)) Detach(face);
  for (const Slot slot : gone.slots) EraseFrom(&faces_of_slot_[slot], face);
  LeaveBlock(face);
  gone = Face();
  unused_.push_back(face);
}

void FacePool::Detach(FaceIdx face) {
  face_of_arc_[faces_[face].arc] = kNoFace;
  faces_[face].arc = kNoFaceArc;
}

void FacePool::Attach(FaceIdx face, std::uint32_t arc) {
  PLUMB_CHECK(IsDetached(face));
  faces_[face].arc = arc;
  if (face_of_arc_.size() <= arc) face_of_arc_.resize(arc + 1, kNoFace);
  face_of_arc_[arc] = face;
}

FaceIdx FacePool::FindDetached(const FaceSlots& slots) const {
  for (const FaceIdx face : AroundSlot(slots[0])) {
    if (IsDetached(face) && faces_[face].slots == slots) return face;
  }
  return kNoFace;
}

void FacePool::MoveTo(FaceIdx face, const BlockId& block) {
  LeaveBlock(face);
  faces_[face].block = block;
  faces_of_block_[block].push_back(face);
}

void FacePool::LeaveBlock(FaceIdx face) {
  const auto it = faces_of_block_.find(faces_[face].block);
  EraseFrom(&it->second, face);
  if (it->second.empty()) faces_of_block_.erase(it);
}

const std::vector<FaceIdx>& FacePool::AroundSlot(Slot slot) const {
  return slot < faces_of_slot_.size() ? faces_of_slot_[slot] : NoFaces();
}

const std::vector<FaceIdx>& FacePool::InBlock(const BlockId& block) const {
  const auto it = faces_of_block_.find(block);
  return it != faces_of_block_.end() ? it->second : NoFaces();
}

std::vector<BlockId> FacePool::Blocks() const {
  std::vector<BlockId> blocks;
  blocks.reserve(faces_of_block_.size());
  for (const auto& [id, faces] : faces_of_block_) blocks.push_back(id);
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

}  // namespace plumb
