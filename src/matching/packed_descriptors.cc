// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/packed_descriptors.h"

#include <cstring>

#include "plumbline/image/features.h"

namespace plumb::internal {
namespace {

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

int TileSize(const TileKernel& kernel, PackedSide side) {
  return side == PackedSide::kRows ? kernel.tile_rows : kernel.tile_vectors * kernel.lanes;
}

// Copies one descriptor to its place among the `group` interleaved ones, as elements of type T.
template <typename T>
void Interleave(
    const std::uint8_t* descriptor, int offset, int chunk, int group, int place, T* packed) {
  T elements[kDescriptorSize];
  for (int k = 0; k < kDescriptorSize; ++k) elements[k] = static_cast<T>(descriptor[k] - offset);
  T* target = packed + place * chunk;
  for (int k = 0; k < kDescriptorSize; k += chunk, target += group * chunk) {
    std::memcpy(target, elements + k, static_cast<std::size_t>(chunk) * sizeof(T));
  }
}

}  // namespace

PackedDescriptors::PackedDescriptors(const TileKernel& kernel,
                                     PackedSide side,
                                     const DescriptorSpan& descriptors)
    : num_padded_(RoundUp(descriptors.count, TileSize(kernel, side))),
      descriptor_bytes_(kDescriptorSize * kernel.element_bytes),
      bytes_(static_cast<std::size_t>(num_padded_) * static_cast<std::size_t>(descriptor_bytes_),
             0),
      biases_(static_cast<std::size_t>(num_padded_), 0),
      squared_norms_(static_cast<std::size_t>(num_padded_), kPaddingNorm2) {
  Pack(kernel, side, descriptors);
}

const std::uint8_t* PackedDescriptors::Tile(int begin) const {
  return bytes_.data() +
         static_cast<std::size_t>(begin) * static_cast<std::size_t>(descriptor_bytes_);
}

void PackedDescriptors::Pack(const TileKernel& kernel,
                             PackedSide side,
                             const DescriptorSpan& descriptors) {
  static constexpr std::uint8_t kZeros[kDescriptorSize] = {};
  const int group = side == PackedSide::kRows ? kernel.tile_rows : kernel.lanes;
  const bool is_bytes = kernel.element_bytes == 1;
  const int offset = is_bytes && side == PackedSide::kRows ? 128 : 0;
  for (int i = 0; i < num_padded_; ++i) {
    const bool is_padding = i >= descriptors.count;
    const std::uint8_t* descriptor =
        is_padding ? kZeros : descriptors.data + static_cast<std::ptrdiff_t>(i) * kDescriptorSize;
    std::uint8_t* packed =
        bytes_.data() + static_cast<std::ptrdiff_t>(i / group * group) * descriptor_bytes_;
    if (is_bytes) {
      Interleave(descriptor, offset, kernel.chunk, group, i % group, packed);
    } else {
      Interleave(descriptor,
                 offset,
                 kernel.chunk,
                 group,
                 i % group,
                 reinterpret_cast<std::int16_t*>(packed));
    }
    if (is_padding) continue;
    std::int32_t sum = 0;
    std::int32_t squared_norm = 0;
    for (int k = 0; k < kDescriptorSize; ++k) {
      sum += descriptor[k];
      squared_norm += descriptor[k] * descriptor[k];
    }
    squared_norms_[static_cast<std::size_t>(i)] = squared_norm;
    if (is_bytes) biases_.data()[i] = 128 * sum;
  }
}

}  // namespace plumb::internal
