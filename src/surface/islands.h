// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/face_pool.h"

namespace plumb {

// Tells islands, sets of fewer than `min_faces` faces that are connected by common landmarks but
// not with any other face, from the rest. The cost grows with the change, not with the mesh.
class IslandFinder {
 public:
  explicit IslandFinder(int min_faces) : min_faces_(static_cast<std::size_t>(min_faces)) {}

  // Brings the marks of `pool` up to date after faces around `slots` came or went. Gives the faces
  // whose mark changed; faces that came count as not marked before.
  std::vector<FaceIdx> Update(const std::vector<Slot>& slots, FacePool* pool);

 private:
  enum class Size : std::uint8_t { kUnknown, kSmall, kLarge };

  void Decide(FaceIdx start, FacePool* pool);
  void ClearMarks(FaceIdx start, FacePool* pool);
  void SetMark(FaceIdx face, bool is_island, FacePool* pool);
  template <typename Visitor>
  static void ForEachNeighbor(const FacePool& pool, FaceIdx face, Visitor&& visit);

  std::size_t min_faces_;
  std::vector<Size> size_of_;        // By face: of its set; all unknown between updates.
  std::vector<FaceIdx> decided_;     // Those that are not.
  std::vector<std::uint32_t> seen_;  // By face: the search that came by.
  std::uint32_t search_ = 0;
  std::vector<FaceIdx> changed_;
};

}  // namespace plumb
