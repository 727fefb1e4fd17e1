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

namespace plumb::internal {
namespace {

// 24 sums, four columns and a row fill 29 of the 32 registers.
constexpr int kTileRows = 6;
constexpr int kTileVectors = 4;
constexpr int kLanes = 16;
constexpr int kChunk = 4;
constexpr int kSteps = kDescriptorSize / kChunk;

__attribute__((target("avx512f,avx512vnni"))) void RunAvx512Vnni(const TileJob& job) {
  const auto* rows = static_cast<const std::int32_t*>(job.rows);
  const auto* columns = static_cast<const __m512i*>(job.columns);
  __m512i dots[kTileRows][kTileVectors];
#pragma GCC unroll 6
  for (int v = 0; v < kTileVectors; ++v) {
    const __m512i bias =
        _mm512_load_si512(reinterpret_cast<const __m512i*>(job.column_biases + v * kLanes));
#pragma GCC unroll 6
    for (int r = 0; r < kTileRows; ++r) dots[r][v] = bias;
  }
  for (int k = 0; k < kSteps; ++k) {
    __m512i column[kTileVectors];
#pragma GCC unroll 6
    for (int v = 0; v < kTileVectors; ++v) {
      column[v] = _mm512_load_si512(columns + v * kSteps + k);
    }
#pragma GCC unroll 6
    for (int r = 0; r < kTileRows; ++r) {
      const __m512i row = _mm512_set1_epi32(rows[k * kTileRows + r]);
#pragma GCC unroll 6
      for (int v = 0; v < kTileVectors; ++v) {
        dots[r][v] = _mm512_dpbusd_epi32(dots[r][v], column[v], row);
      }
    }
  }
#pragma GCC unroll 6
  for (int v = 0; v < kTileVectors; ++v) {
    auto* column_best = reinterpret_cast<__m512i*>(job.column_best + v * kLanes);
    const __m512i column_term =
        _mm512_load_si512(reinterpret_cast<const __m512i*>(job.column_terms + v * kLanes));
    __m512i smallest = _mm512_load_si512(column_best);
#pragma GCC unroll 6
    for (int r = 0; r < kTileRows; ++r) {
      auto* row_best = reinterpret_cast<__m512i*>(job.row_best + r * kLanes);
      auto* row_second = reinterpret_cast<__m512i*>(job.row_second + r * kLanes);
      const __m512i shifted = _mm512_slli_epi32(dots[r][v], kKeyIndexBits + 1);
      const __m512i row_key = _mm512_sub_epi32(column_term, shifted);
      const __m512i best = _mm512_load_si512(row_best);
      const __m512i loser = _mm512_max_epi32(best, row_key);
      _mm512_store_si512(row_best, _mm512_min_epi32(best, row_key));
      _mm512_store_si512(row_second, _mm512_min_epi32(_mm512_load_si512(row_second), loser));
      const __m512i column_key = _mm512_sub_epi32(_mm512_set1_epi32(job.row_terms[r]), shifted);
      smallest = _mm512_min_epi32(smallest, column_key);
    }
    _mm512_store_si512(column_best, smallest);
  }
}

}  // namespace

const TileKernel& Avx512VnniKernel() {
  static const TileKernel kernel{kTileRows, kTileVectors, kLanes, 1, kChunk, &RunAvx512Vnni};
  return kernel;
}

}  // namespace plumb::internal

#endif
