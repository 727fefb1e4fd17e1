// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/tile_kernel.h"
#include "plumbline/image/features.h"

#if defined(__x86_64__)

// GCC 12 takes the deliberately undefined operand of its own intrinsics for a mistake
// (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>

#define PLUMB_INLINE_TARGET __attribute__((target("avx512f,avx512vnni"), always_inline)) inline

namespace plumb::internal {
namespace {

// 24 sums, four columns and a row fill 29 of the 32 registers.
constexpr int kTileRows = 6;
constexpr int kTileVectors = 4;
constexpr int kLanes = 16;
constexpr int kChunk = 4;
constexpr int kSteps = kDescriptorSize / kChunk;

// One register for each group of columns of the tile.
struct Registers {
  __m512i v0, v1, v2, v3;
};

PLUMB_INLINE_TARGET __m512i Load(const std::int32_t* values) { return _mm512_load_si512(values); }

PLUMB_INLINE_TARGET void Store(const __m512i& values, std::int32_t* target) {
  _mm512_store_si512(target, values);
}

PLUMB_INLINE_TARGET Registers LoadAll(const std::int32_t* values, int stride) {
  return {
      Load(values), Load(values + stride), Load(values + 2 * stride), Load(values + 3 * stride)};
}

PLUMB_INLINE_TARGET void StoreAll(const Registers& values, std::int32_t* target) {
  Store(values.v0, target);
  Store(values.v1, target + kLanes);
  Store(values.v2, target + 2 * kLanes);
  Store(values.v3, target + 3 * kLanes);
}

// sums += dot products of unsigned bytes of `columns` and signed bytes of `row`, by groups of four.
// Not by the intrinsic: GCC 12 then stores every sum in every step, which takes twice the time.
PLUMB_INLINE_TARGET void AddProducts(const __m512i& columns, const __m512i& row, __m512i* sums) {
  __asm__("vpdpbusd %2, %1, %0" : "+v"(*sums) : "v"(columns), "v"(row));
}

// Adds the products of four elements of a row with those of all columns.
PLUMB_INLINE_TARGET void Accumulate(const Registers& columns,
                                    std::int32_t packed_row,
                                    Registers* sums) {
  const __m512i row = _mm512_set1_epi32(packed_row);
  AddProducts(columns.v0, row, &sums->v0);
  AddProducts(columns.v1, row, &sums->v1);
  AddProducts(columns.v2, row, &sums->v2);
  AddProducts(columns.v3, row, &sums->v3);
}

// Writes the dot products of the tile, by row. Not inlined: what follows would cost registers here.
__attribute__((target("avx512f,avx512vnni"), noinline)) void Multiply(const TileJob& job,
                                                                      std::int32_t* dots) {
  const auto* rows = static_cast<const std::int32_t*>(job.rows);
  const auto* columns = static_cast<const std::int32_t*>(job.columns);
  Registers sums0, sums1, sums2, sums3, sums4, sums5;
  sums0 = sums1 = sums2 = sums3 = sums4 = sums5 = LoadAll(job.column_biases, kLanes);
  for (int k = 0; k < kSteps; ++k, rows += kTileRows, columns += kLanes) {
    const Registers column = LoadAll(columns, kSteps * kLanes);
    Accumulate(column, rows[0], &sums0);
    Accumulate(column, rows[1], &sums1);
    Accumulate(column, rows[2], &sums2);
    Accumulate(column, rows[3], &sums3);
    Accumulate(column, rows[4], &sums4);
    Accumulate(column, rows[5], &sums5);
  }
  StoreAll(sums0, dots);
  StoreAll(sums1, dots + kTileVectors * kLanes);
  StoreAll(sums2, dots + 2 * kTileVectors * kLanes);
  StoreAll(sums3, dots + 3 * kTileVectors * kLanes);
  StoreAll(sums4, dots + 4 * kTileVectors * kLanes);
  StoreAll(sums5, dots + 5 * kTileVectors * kLanes);
}

__attribute__((target("avx512f,avx512vnni"))) void RunAvx512Vnni(const TileJob& job) {
  alignas(64) std::int32_t dots[kTileRows * kTileVectors * kLanes];
  Multiply(job, dots);
  for (int v = 0; v < kTileVectors; ++v) {
    const __m512i column_terms = Load(job.column_terms + v * kLanes);
    __m512i column_best = Load(job.column_best + v * kLanes);
    for (int row = 0; row < kTileRows; ++row) {
      std::int32_t* row_best = job.row_best + row * kLanes;
      std::int32_t* row_second = job.row_second + row * kLanes;
      const __m512i dot = Load(dots + (row * kTileVectors + v) * kLanes);
      const __m512i shifted = _mm512_slli_epi32(dot, kKeyIndexBits + 1);
      const __m512i row_key = _mm512_sub_epi32(column_terms, shifted);
      const __m512i best = Load(row_best);
      Store(_mm512_min_epi32(best, row_key), row_best);
      const __m512i loser = _mm512_max_epi32(best, row_key);
      Store(_mm512_min_epi32(Load(row_second), loser), row_second);
      const __m512i row_term = _mm512_set1_epi32(job.row_terms[row]);
      column_best = _mm512_min_epi32(column_best, _mm512_sub_epi32(row_term, shifted));
    }
    Store(column_best, job.column_best + v * kLanes);
  }
}

}  // namespace

const TileKernel& Avx512VnniKernel() {
  static const TileKernel kernel{kTileRows, kTileVectors, kLanes, 1, kChunk, &RunAvx512Vnni};
  return kernel;
}

}  // namespace plumb::internal

#endif
