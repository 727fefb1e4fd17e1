// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace plumb::internal {

// The instruction sets the matcher knows, slowest first.
enum class SimdPath { kPortable, kAvx2, kAvxVnni, kAvx512Vnni };

// Low bits of a key that hold an index; the rest holds a value of up to 24 bits, signed.
// |b|^2 - 2 a.b lies within +-128 * 255^2, which fits.
constexpr int kKeyIndexBits = 8;

// One tile of the matrix of dot products: `tile_rows` descriptors a against
// `tile_vectors` groups of `lanes` descriptors b. For each pair the keys
//   row key:    (|b|^2 - 2 a.b) << kKeyIndexBits | index of b's group in its panel
//   column key: (|a|^2 - 2 a.b) << kKeyIndexBits | index of a's row in its block
// order the candidates of a row and of a column by distance, then by index.
struct TileJob {
  const void* rows;                   // Packed.
  const void* columns;                // Packed.
  const std::int32_t* row_terms;      // [tile_rows] column key without -2 a.b.
  const std::int32_t* column_terms;   // [tile_vectors * lanes] row key without -2 a.b.
  const std::int32_t* column_biases;  // [tile_vectors * lanes] added to the packed dot product.
  std::int32_t* row_best;             // [tile_rows * lanes] smallest row key by lane.
  std::int32_t* row_second;           // [tile_rows * lanes] second smallest row key by lane.
  std::int32_t* column_best;          // [tile_vectors * lanes] smallest column key.
};

// How the descriptors of a tile are stored: elements of one byte (columns as they are, rows minus
// 128) or of two bytes, groups of `group` descriptors interleaved by chunks of `chunk` elements.
struct TileKernel {
  int tile_rows;
  int tile_vectors;
  int lanes;
  int element_bytes;
  int chunk;
  void (*run)(const TileJob& job);
};

const TileKernel& PortableKernel();
#if defined(__x86_64__)
const TileKernel& Avx2Kernel();
const TileKernel& AvxVnniKernel();
const TileKernel& Avx512VnniKernel();
#endif

bool IsSupported(SimdPath path);

// The fastest path of this processor.
SimdPath BestSimdPath();

// `path` must be supported.
const TileKernel& KernelOf(SimdPath path);

}  // namespace plumb::internal
