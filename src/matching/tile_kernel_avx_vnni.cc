// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/tile_kernel.h"
#include "plumbline/image/features.h"

#if defined(__x86_64__)

#include <immintrin.h>

namespace plumb::internal {
namespace {

// Nine sums, three columns and a row fill 13 of the 16 registers.
constexpr int kTileRows = 3;
constexpr int kTileVectors = 3;
constexpr int kLanes = 8;
constexpr int kChunk = 4;
constexpr int kSteps = kDescriptorSize / kChunk;

__attribute__((target("avx2,avxvnni"))) void RunAvxVnni(const TileJob& job) {
  const auto* rows = static_cast<const std::int32_t*>(job.rows);
  const auto* columns = static_cast<const __m256i*>(job.columns);
  __m256i dots[kTileRows][kTileVectors];
#pragma GCC unroll 4
  for (int v = 0; v < kTileVectors; ++v) {
    const __m256i bias =
        _mm256_load_si256(reinterpret_cast<const __m256i*>(job.column_biases + v * kLanes));
#pragma GCC unroll 4
    for (int r = 0; r < kTileRows; ++r) dots[r][v] = bias;
  }
  for (int k = 0; k < kSteps; ++k) {
    __m256i column[kTileVectors];
#pragma GCC unroll 4
    for (int v = 0; v < kTileVectors; ++v) {
      column[v] = _mm256_load_si256(columns + v * kSteps + k);
    }
#pragma GCC unroll 4
    for (int r = 0; r < kTileRows; ++r) {
      const __m256i row = _mm256_set1_epi32(rows[k * kTileRows + r]);
#pragma GCC unroll 4
      for (int v = 0; v < kTileVectors; ++v) {
        dots[r][v] = _mm256_dpbusd_avx_epi32(dots[r][v], column[v], row);
      }
    }
  }
#pragma GCC unroll 4
  for (int v = 0; v < kTileVectors; ++v) {
    auto* column_best = reinterpret_cast<__m256i*>(job.column_best + v * kLanes);
    const __m256i column_term =
        _mm256_load_si256(reinterpret_cast<const __m256i*>(job.column_terms + v * kLanes));
    __m256i smallest = _mm256_load_si256(column_best);
#pragma GCC unroll 4
    for (int r = 0; r < kTileRows; ++r) {
      auto* row_best = reinterpret_cast<__m256i*>(job.row_best + r * kLanes);
      auto* row_second = reinterpret_cast<__m256i*>(job.row_second + r * kLanes);
      const __m256i shifted = _mm256_slli_epi32(dots[r][v], kKeyIndexBits + 1);
      const __m256i row_key = _mm256_sub_epi32(column_term, shifted);
      const __m256i best = _mm256_load_si256(row_best);
      const __m256i loser = _mm256_max_epi32(best, row_key);
      _mm256_store_si256(row_best, _mm256_min_epi32(best, row_key));
      _mm256_store_si256(row_second, _mm256_min_epi32(_mm256_load_si256(row_second), loser));
      const __m256i column_key = _mm256_sub_epi32(_mm256_set1_epi32(job.row_terms[r]), shifted);
      smallest = _mm256_min_epi32(smallest, column_key);
    }
    _mm256_store_si256(column_best, smallest);
  }
}

}  // namespace

const TileKernel& AvxVnniKernel() {
  static const TileKernel kernel{kTileRows, kTileVectors, kLanes, 1, kChunk, &RunAvxVnni};
  return kernel;
}

}  // namespace plumb::internal

#endif
