// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/content_hash.h"

namespace plumb {
namespace {

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325U;
constexpr std::uint64_t kFnvPrime = 0x100000001b3U;

// Little-endian word of the first `count` (at most 8) bytes; compilers make a plain load of it.
std::uint64_t LoadWord(const std::uint8_t* bytes, std::size_t count) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; ++i) word |= std::uint64_t{bytes[i]} << (8 * i);
  return word;
}

// MurmurHash3's fmix64 (A. Appleby, public domain).
std::uint64_t MixBits(std::uint64_t hash) {
  hash ^= hash >> 33;
  hash *= 0xff51afd7ed558ccdU;
  hash ^= hash >> 33;
  hash *= 0xc4ceb9fe1a85ec53U;
  return hash ^ (hash >> 33);
}

}  // namespace

std::uint64_t ContentHash(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t hash = (kFnvOffset ^ size) * kFnvPrime;
  std::size_t position = 0;
  for (; position + 8 <= size; position += 8) {
    // The rotation brings high bits back into the low half, where the prime spreads them.
    hash = (hash ^ LoadWord(bytes + position, 8)) * kFnvPrime;
    hash = (hash << 29) | (hash >> 35);
  }
  if (position < size) hash = (hash ^ LoadWord(bytes + position, size - position)) * kFnvPrime;
  return MixBits(hash);
}

}  // namespace plumb
