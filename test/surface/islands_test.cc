// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/islands.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "test/support/random.h"

namespace plumb {
namespace {

constexpr int kMinFaces = 6;

// Marks of all faces by flooding each connected set.
std::map<FaceIdx, bool> MarksFromScratch(const FacePool& pool) {
  std::map<FaceIdx, bool> is_island;
  for (FaceIdx start = 0; start < pool.capacity(); ++start) {
    if (!pool[start].is_used || is_island.count(start) != 0) continue;
    std::set<FaceIdx> found = {start};
    std::vector<FaceIdx> open = {start};
    while (!open.empty()) {
      const FaceIdx face = open.back();
      open.pop_back();
      for (const Slot slot : pool[face].slots) {
        for (const FaceIdx neighbor : pool.AroundSlot(slot)) {
          if (found.insert(neighbor).second) open.push_back(neighbor);
        }
      }
    }
    for (const FaceIdx face : found) is_island[face] = found.size() < kMinFaces;
  }
  return is_island;
}

// Triangles of a grid come and go at random.
TEST(IslandFinder, MarksWhatAFloodMarksAfterEveryChange) {
  constexpr Slot kSide = 14;
  test::Random random(4);
  FacePool pool;
  IslandFinder finder(kMinFaces);
  std::size_t num_marks_changed = 0;
  for (int step = 0; step < 3000; ++step) {
    std::vector<Slot> slots;
    const int num_changes = 1 + random.Index(4);
    for (int i = 0; i < num_changes; ++i) {
      const auto x = static_cast<Slot>(random.Index(kSide - 1));
      const auto y = static_cast<Slot>(random.Index(kSide - 1));
      const Slot corner = kSide * y + x;
      const FaceSlots face = {corner, corner + 1, corner + kSide};
      const FaceIdx there = pool.AtArc(corner);
      slots.insert(slots.end(), face.begin(), face.end());
      if (there != kNoFace) {
        pool.Remove(there);
      } else if (random.Index(2) == 0) {
        pool.Add(corner, face, {}, {});
      }
    }
    num_marks_changed += finder.Update(slots, &pool).size();
    for (const auto& [face, is_island] : MarksFromScratch(pool)) {
      ASSERT_EQ(pool[face].is_island, is_island) << "step " << step;
    }
  }
  EXPECT_GT(num_marks_changed, 1000U);
}

TEST(IslandFinder, KeepsEverythingIfAskedTo) {
  FacePool pool;
  pool.Add(0, {0, 1, 2}, {}, {});
  EXPECT_TRUE(IslandFinder(1).Update({0, 1, 2}, &pool).empty());
  EXPECT_FALSE(pool[0].is_island);
}

}  // namespace
}  // namespace plumb
