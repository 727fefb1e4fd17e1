// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "matching/neighbor_search.h"
#include "matching/tile_kernel.h"

namespace plumb::internal {

// An array that starts on a cache line, as the kernels' aligned loads need.
template <typename T>
class AlignedArray {
 public:
  AlignedArray(std::size_t size, T value)
      : lines_((size * sizeof(T) + sizeof(Line) - 1) / sizeof(Line)) {
    for (std::size_t i = 0; i < size; ++i) data()[i] = value;
  }
  T* data() { return reinterpret_cast<T*>(lines_.data()); }
  const T* data() const { return reinterpret_cast<const T*>(lines_.data()); }

 private:
  struct alignas(64) Line {
    unsigned char bytes[64];
  };
  std::vector<Line> lines_;
};

enum class PackedSide { kRows, kColumns };

// Descriptors in the order in which a kernel reads them, padded with zero descriptors to whole
// tiles. Padding has squared norm kPaddingNorm2 and so never is a nearest neighbour.
class PackedDescriptors {
 public:
  static constexpr std::int32_t kPaddingNorm2 = -1;

  PackedDescriptors(const TileKernel& kernel, PackedSide side, const DescriptorSpan& descriptors);

  int num_padded() const { return num_padded_; }
  // The packed tile that begins at descriptor `begin`, a multiple of the tile's size.
  const std::uint8_t* Tile(int begin) const;
  const std::vector<std::int32_t>& squared_norms() const { return squared_norms_; }
  // What the packed dot product of a column lacks because rows are stored minus 128.
  const std::int32_t* biases() const { return biases_.data(); }

 private:
  void Pack(const TileKernel& kernel, PackedSide side, const DescriptorSpan& descriptors);

  int num_padded_;
  int descriptor_bytes_;
  AlignedArray<std::uint8_t> bytes_;
  AlignedArray<std::int32_t> biases_;
  std::vector<std::int32_t> squared_norms_;
};

}  // namespace plumb::internal
