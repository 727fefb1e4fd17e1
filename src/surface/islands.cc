// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/islands.h"

namespace plumb {

template <typename Visitor>
void IslandFinder::ForEachNeighbor(const FacePool& pool, FaceIdx face, Visitor&& visit) {
  for (const Slot slot : pool[face].slots) {
    for (const FaceIdx neighbor : pool.AroundSlot(slot)) {
      if (neighbor != face) visit(neighbor);
    }
  }
}

std::vector<FaceIdx> IslandFinder::Update(const std::vector<Slot>& slots, FacePool* pool) {
  changed_.clear();
  size_of_.resize(pool->capacity(), Size::kUnknown);
  seen_.resize(pool->capacity(), 0);
  for (const Slot slot : slots) {
    for (const FaceIdx face : pool->AroundSlot(slot)) {
      if (size_of_[face] == Size::kUnknown) Decide(face, pool);
    }
  }
  for (const FaceIdx face : decided_) size_of_[face] = Size::kUnknown;
  decided_.clear();
  return changed_;
}

// Searches from `start` until there are faces enough, one known to have enough, or no more.
void IslandFinder::Decide(FaceIdx start, FacePool* pool) {
  ++search_;
  std::vector<FaceIdx> found = {start};
  seen_[start] = search_;
  bool is_large = min_faces_ <= 1;
  for (std::size_t i = 0; i < found.size() && !is_large; ++i) {
    ForEachNeighbor(*pool, found[i], [&](FaceIdx neighbor) {
      if (seen_[neighbor] == search_) return;
      seen_[neighbor] = search_;
      found.push_back(neighbor);
      is_large = is_large || size_of_[neighbor] == Size::kLarge || found.size() >= min_faces_;
    });
  }
  for (const FaceIdx face : found) {
    if (size_of_[face] == Size::kUnknown) decided_.push_back(face);
    size_of_[face] = is_large ? Size::kLarge : Size::kSmall;
    SetMark(face, !is_large, pool);
  }
  if (!is_large) return;
  // An island that grew together with the rest is still marked beyond what was searched.
  for (const FaceIdx face : found) ClearMarks(face, pool);
}

void IslandFinder::ClearMarks(FaceIdx start, FacePool* pool) {
  std::vector<FaceIdx> open = {start};
  while (!open.empty()) {
    const FaceIdx face = open.back();
    open.pop_back();
    ForEachNeighbor(*pool, face, [&](FaceIdx neighbor) {
      if (!(*pool)[neighbor].is_island) return;
      SetMark(neighbor, false, pool);
      open.push_back(neighbor);
    });
  }
}

void IslandFinder::SetMark(FaceIdx face, bool is_island, FacePool* pool) {
  if ((*pool)[face].is_island == is_island) return;
  pool->SetIsland(face, is_island);
  changed_.push_back(face);
}

}  // namespace plumb
