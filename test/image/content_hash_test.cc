// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/content_hash.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace plumb {
namespace {

std::vector<std::uint8_t> CountingBytes(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i);
  return bytes;
}

TEST(ContentHash, ChangesWithEveryBit) {
  std::vector<std::uint8_t> bytes = CountingBytes(37);  // With a part of a word at the end.
  std::set<std::uint64_t> hashes = {ContentHash(bytes.data(), bytes.size())};
  for (std::uint8_t& byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      byte = static_cast<std::uint8_t>(byte ^ (1U << bit));
      hashes.insert(ContentHash(bytes.data(), bytes.size()));
      byte = static_cast<std::uint8_t>(byte ^ (1U << bit));
    }
  }
  EXPECT_EQ(hashes.size(), 37U * 8U + 1U);
}

TEST(ContentHash, TellsLengthsOfZerosApart) {
  const std::vector<std::uint8_t> zeros(64, 0);
  std::set<std::uint64_t> hashes;
  for (std::size_t size = 0; size <= zeros.size(); ++size) {
    hashes.insert(ContentHash(zeros.data(), size));
  }
  EXPECT_EQ(hashes.size(), zeros.size() + 1);
}

TEST(ContentHash, IsTheSameAtAnyAddress) {
  const std::vector<std::uint8_t> bytes = CountingBytes(100);
  std::vector<std::uint8_t> shifted(1, 0);
  shifted.insert(shifted.end(), bytes.begin(), bytes.end());
  EXPECT_EQ(ContentHash(bytes.data(), bytes.size()), ContentHash(shifted.data() + 1, bytes.size()));
}

}  // namespace
}  // namespace plumb
