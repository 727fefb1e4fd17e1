// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/tile_kernel.h"
#include "plumbline/image/features.h"

#if defined(__x86_64__)

#include <immintrin.h>

#define PLUMB_INLINE_TARGET __attribute__((target("avx2,avxvnni"), always_inline)) inline

namespace plumb::internal {
namespace {

// Nine sums, three columns and a row fill 13 of the 16 registers.
constexpr int kTileRows = 3;
constexpr int kTileVectors = 3;
constexpr int kLanes = 8;
constexpr int kChunk = 4;
constexpr int kSteps = kDescriptorSize / kChunk;

// One register for each group of columns of the tile.
struct Registers {
  __m256i v0, v1, v2;
};

PLUMB_INLINE_TARGET __m256i Load(const std::int32_t* values) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(values));
}

PLUMB_INLINE_TARGET void Store(const __m256i& values, std::int32_t* target) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(target), values);
}

PLUMB_INLINE_TARGET Registers LoadAll(const std::int32_t* values, int stride) {
  return {Load(values), Load(values + stride), Load(values + 2 * stride)};
}

PLUMB_INLINE_TARGET void StoreAll(const Registers& values, std::int32_t* target) {
  Store(values.v0, target);
  Store(values.v1, target + kLanes);
  Store(values.v2, target + 2 * kLanes);
}

// sums += dot products of unsigned bytes of `columns` and signed bytes of `row`, by groups of four.
// Not by the intrinsic: GCC 12 then stores every sum in every step, which takes twice the time.
PLUMB_INLINE_TARGET void AddProducts(const __m256i& columns, const __m256i& row, __m256i* sums) {
  __asm__("%{vex%} vpdpbusd %2, %1, %0" : "+x"(*sums) : "x"(columns), "x"(row));
}

// Adds the products of four elements of a row with those of all columns.
PLUMB_INLINE_TARGET void Accumulate(const Registers& columns,
                                    std::int32_t packed_row,
                                    Registers* sums) {
  const __m256i row = _mm256_set1_epi32(packed_row);
  AddProducts(columns.v0, row, &sums->v0);
  AddProducts(columns.v1, row, &sums->v1);
  AddProducts(columns.v2, row, &sums->v2);
}

// Writes the dot products of the tile, by row. Not inlined: what follows would cost registers here.
__attribute__((target("avx2,avxvnni"), noinline)) void Multiply(const TileJob& job,
                                                                std::int32_t* dots) {
  const auto* rows = static_cast<const std::int32_t*>(job.rows);
  const auto* columns = static_cast<const std::int32_t*>(job.columns);
  Registers sums0, sums1, sums2;
  sums0 = sums1 = sums2 = LoadAll(job.column_biases, kLanes);
  for (int k = 0; k < kSteps; ++k, rows += kTileRows, columns += kLanes) {
    const Registers column = LoadAll(columns, kSteps * kLanes);
    Accumulate(column, rows[0], &sums0);
    Accumulate(column, rows[1], &sums1);
    Accumulate(column, rows[2], &sums2);
  }
  StoreAll(sums0, dots);
  StoreAll(sums1, dots + kTileVectors * kLanes);
  StoreAll(sums2, dots + 2 * kTileVectors * kLanes);
}

__attribute__((target("avx2,avxvnni"))) void RunAvxVnni(const TileJob& job) {
  alignas(64) std::int32_t dots[kTileRows * kTileVectors * kLanes];
  Multiply(job, dots);
  for (int v = 0; v < kTileVectors; ++v) {
    const __m256i column_terms = Load(job.column_terms + v * kLanes);
    __m256i column_best = Load(job.column_best + v * kLanes);
    for (int row = 0; row < kTileRows; ++row) {
      std::int32_t* row_best = job.row_best + row * kLanes;
      std::int32_t* row_second = job.row_second + row * kLanes;
      const __m256i dot = Load(dots + (row * kTileVectors + v) * kLanes);
      const __m256i shifted = _mm256_slli_epi32(dot, kKeyIndexBits + 1);
      const __m256i row_key = _mm256_sub_epi32(column_terms, shifted);
      const __m256i best = Load(row_best);
      Store(_mm256_min_epi32(best, row_key), row_best);
      const __m256i loser = _mm256_max_epi32(best, row_key);
      Store(_mm256_min_epi32(Load(row_second), loser), row_second);
      const __m256i row_term = _mm256_set1_epi32(job.row_terms[row]);
      column_best = _mm256_min_epi32(column_best, _mm256_sub_epi32(row_term, shifted));
    }
    Store(column_best, job.column_best + v * kLanes);
  }
}

}  // namespace

const TileKernel& AvxVnniKernel() {
  static const TileKernel kernel{kTileRows, kTileVectors, kLanes, 1, kChunk, &RunAvxVnni};
  return kernel;
}

}  // namespace plumb::internal

#endif
