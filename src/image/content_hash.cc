// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/content_hash.h"

namespace plumb {
namespace {

constexpr std::uint64_t kMultiplier = 0xc6a4a7935bd1e995U;
constexpr int kShift = 47;

// Little-endian word of the first `count` (at most 8) bytes; compilers make a plain load of it.
std::uint64_t LoadWord(const std::uint8_t* bytes, std::size_t count) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; ++i) word |= std::uint64_t{bytes[i]} << (8 * i);
  return word;
}

}  // namespace

std::uint64_t ContentHash(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t hash = size * kMultiplier;
  std::size_t position = 0;
  for (; position + 8 <= size; position += 8) {
    std::uint64_t word = LoadWord(bytes + position, 8) * kMultiplier;
    word ^= word >> kShift;
    hash = (hash ^ (word * kMultiplier)) * kMultiplier;
  }
  if (position < size) hash = (hash ^ LoadWord(bytes + position, size - position)) * kMultiplier;
  hash = (hash ^ (hash >> kShift)) * kMultiplier;
  return hash ^ (hash >> kShift);
}

}  // namespace plumb
