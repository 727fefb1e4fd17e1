// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "matching/tile_kernel.h"

namespace plumb::internal {

constexpr std::int32_t kNoNeighbor = -1;
constexpr std::int32_t kInfiniteDistance2 = std::numeric_limits<std::int32_t>::max();

// The two nearest columns of a row; equal distances go to the smaller index.
struct RowNeighbors {
  std::int32_t best_idx = kNoNeighbor;
  std::int32_t best_distance2 = kInfiniteDistance2;
  std::int32_t second_distance2 = kInfiniteDistance2;  // Equals the best in a tie.
};

struct Neighbors {
  std::vector<RowNeighbors> rows;             // By descriptor of the first set.
  std::vector<std::int32_t> column_best_idx;  // By descriptor of the second set: nearest row.
};

// `count` descriptors of kDescriptorSize bytes, one after the other.
struct DescriptorSpan {
  const std::uint8_t* data = nullptr;
  int count = 0;
};

// Exact nearest neighbours in both directions from one pass over the integer dot products. The
// same for every path and number of threads.
Neighbors FindNeighbors(SimdPath path,
                        const DescriptorSpan& rows,
                        const DescriptorSpan& columns,
                        int num_threads);

}  // namespace plumb::internal
