// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

// A word of kNumCodeBits bits read at an unknown rotation, looked up.
struct CodeMatch {
  int id = 0;
  int rotation = 0;    // The word is the code turned by so many cells: RotateWord(code, rotation).
  int num_errors = 0;  // Bits that were wrong: 0 or 1.
};

// The code of each marker ID. No two codes differ in less than 4 bits at any rotation, nor a code
// from itself: one wrong bit is corrected, two are noticed, and a marker has one upright. Every
// code has 5 to 12 white cells, so that all look equally dark, and no 7 equal cells in a row, so
// that every quarter of a marker shows an edge. IDs count from 0 in the order of the codes, which
// is fixed for good: the smallest of a word's rotations stands for it, and the smallest word that
// keeps its distance from all before is next. Thread-safe: immutable.
class MarkerCodebook {
 public:
  // Built once, at the first call.
  static const MarkerCodebook& Get();

  int size() const { return static_cast<int>(words_.size()); }

  // Bit i is cell i. `id` must be in [0, size()).
  std::uint32_t Word(int id) const;

  // Nothing if two bits or more are wrong. Bits above kNumCodeBits must be 0.
  std::optional<CodeMatch> Find(std::uint32_t word) const;

 private:
  struct Entry {
    std::int16_t id = -1;
    std::int8_t rotation = 0;
    std::int8_t num_errors = 0;
  };

  MarkerCodebook();
  void Enter(int id);

  std::vector<std::uint32_t> words_;
  std::vector<Entry> entries_;  // One for each possible word.
};

// The word with cell i in the place of cell (i + cells) modulo kNumCodeBits; 0 <= cells.
std::uint32_t RotateWord(std::uint32_t word, int cells);

}  // namespace plumb
