// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/codebook.h"

#include <algorithm>
#include <bitset>

#include "plumbline/common/check.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

constexpr std::uint32_t kNumWords = std::uint32_t{1} << kNumCodeBits;
constexpr int kMinDistance = 4;
constexpr int kMinWhiteCells = 5;
constexpr int kMaxWhiteCells = 12;
constexpr int kMaxEqualCells = 6;

int Distance(std::uint32_t a, std::uint32_t b) {
  return static_cast<int>(std::bitset<kNumCodeBits>(a ^ b).count());
}

int LongestRun(std::uint32_t word) {
  int longest = 0;
  int run = 1;
  for (int i = 1; i < 2 * kNumCodeBits; ++i) {
    const bool is_equal =
        ((word >> (i % kNumCodeBits)) & 1) == ((word >> ((i - 1) % kNumCodeBits)) & 1);
    run = is_equal ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  return longest;
}

// Smallest of its rotations, and far from all others of them.
bool StandsForItsRotations(std::uint32_t word) {
  for (int cells = 1; cells < kNumCodeBits; ++cells) {
    const std::uint32_t rotated = RotateWord(word, cells);
    if (rotated < word || Distance(rotated, word) < kMinDistance) return false;
  }
  return true;
}

bool IsUsable(std::uint32_t word) {
  const int num_white = Distance(word, 0);
  return num_white >= kMinWhiteCells && num_white <= kMaxWhiteCells &&
         LongestRun(word) <= kMaxEqualCells && StandsForItsRotations(word);
}

bool IsFarFromRotations(std::uint32_t word, std::uint32_t code) {
  for (int cells = 0; cells < kNumCodeBits; ++cells) {
    if (Distance(word, RotateWord(code, cells)) < kMinDistance) return false;
  }
  return true;
}

}  // namespace

std::uint32_t RotateWord(std::uint32_t word, int cells) {
  const int shift = cells % kNumCodeBits;
  return ((word << shift) | (word >> (kNumCodeBits - shift))) & (kNumWords - 1);
}

const MarkerCodebook& MarkerCodebook::Get() {
  static const MarkerCodebook codebook;
  return codebook;
}

MarkerCodebook::MarkerCodebook() : entries_(kNumWords) {
  for (std::uint32_t word = 0; word < kNumWords; ++word) {
    const bool is_free = entries_[word].id < 0;  // Further than 1 from all codes: a quick test.
    if (!is_free || !IsUsable(word)) continue;
    const bool is_far = std::all_of(words_.begin(), words_.end(), [word](std::uint32_t code) {
      return IsFarFromRotations(word, code);
    });
    if (!is_far) continue;
    words_.push_back(word);
    Enter(size() - 1);
  }
}

void MarkerCodebook::Enter(int id) {
  for (int cells = 0; cells < kNumCodeBits; ++cells) {
    const std::uint32_t rotated = RotateWord(Word(id), cells);
    Entry entry;
    entry.id = static_cast<std::int16_t>(id);
    entry.rotation = static_cast<std::int8_t>(cells);
    entries_[rotated] = entry;
    entry.num_errors = 1;
    for (int bit = 0; bit < kNumCodeBits; ++bit) entries_[rotated ^ (1U << bit)] = entry;
  }
}

std::uint32_t MarkerCodebook::Word(int id) const {
  PLUMB_CHECK_GE(id, 0);
  PLUMB_CHECK_LT(id, size());
  return words_[static_cast<std::size_t>(id)];
}

std::optional<CodeMatch> MarkerCodebook::Find(std::uint32_t word) const {
  PLUMB_CHECK_LT(word, kNumWords);
  const Entry& entry = entries_[word];
  if (entry.id < 0) return std::nullopt;
  return CodeMatch{entry.id, entry.rotation, entry.num_errors};
}

}  // namespace plumb
