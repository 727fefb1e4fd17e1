// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

namespace plumb {

// A uniform sampler that does not depend on the library's distributions.
class Sampler {
 public:
  explicit Sampler(int seed) : generator_(static_cast<std::uint32_t>(seed)) {}

  // An index below `size`, which must be positive.
  int Index(int size) {
    const std::uint64_t product = std::uint64_t{generator_()} * static_cast<std::uint32_t>(size);
    return static_cast<int>(product >> 32);
  }

  // kCount distinct indices below `size` >= kCount.
  template <std::size_t kCount>
  std::array<int, kCount> Distinct(int size) {
    std::array<int, kCount> indices = {};
    for (std::size_t i = 0; i < kCount; ++i) {
      do {
        indices[i] = Index(size);
      } while (std::find(indices.begin(), indices.begin() + i, indices[i]) != indices.begin() + i);
    }
    return indices;
  }

 private:
  std::mt19937 generator_;
};

}  // namespace plumb
