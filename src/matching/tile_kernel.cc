// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/tile_kernel.h"

#include <algorithm>

#include "plumbline/common/check.h"
#include "plumbline/image/features.h"

namespace plumb::internal {
namespace {

constexpr int kTileRows = 4;
constexpr int kLanes = 8;

// term - 2 dot << kKeyIndexBits; the key fits 32 bits, its parts need not, so they wrap around.
std::int32_t Key(std::int32_t term, std::int32_t dot) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(term) -
                                   (static_cast<std::uint32_t>(dot) << (kKeyIndexBits + 1)));
}

void RunPortable(const TileJob& job) {
  const auto* rows = static_cast<const std::int16_t*>(job.rows);
  const auto* columns = static_cast<const std::int16_t*>(job.columns);
  for (int row = 0; row < kTileRows; ++row) {
    for (int lane = 0; lane < kLanes; ++lane) {
      std::int32_t dot = 0;
      for (int k = 0; k < kDescriptorSize; ++k) {
        dot += rows[row * kDescriptorSize + k] * columns[lane * kDescriptorSize + k];
      }
      const std::int32_t row_key = Key(job.column_terms[lane], dot);
      std::int32_t& best = job.row_best[row * kLanes + lane];
      std::int32_t& second = job.row_second[row * kLanes + lane];
      second = std::min(second, std::max(best, row_key));
      best = std::min(best, row_key);
      job.column_best[lane] = std::min(job.column_best[lane], Key(job.row_terms[row], dot));
    }
  }
}

}  // namespace

const TileKernel& PortableKernel() {
  static const TileKernel kernel{kTileRows, 1, kLanes, 2, kDescriptorSize, &RunPortable};
  return kernel;
}

bool IsSupported(SimdPath path) {
#if defined(__x86_64__)
  switch (path) {
    case SimdPath::kPortable:
      return true;
    case SimdPath::kAvx2:
      return __builtin_cpu_supports("avx2") != 0;
    case SimdPath::kAvxVnni:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("avxvnni") != 0;
    case SimdPath::kAvx512Vnni:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vnni") != 0;
  }
  return false;
#else
  return path == SimdPath::kPortable;
#endif
}

SimdPath BestSimdPath() {
  static const SimdPath best = [] {
    for (SimdPath path : {SimdPath::kAvx512Vnni, SimdPath::kAvxVnni, SimdPath::kAvx2}) {
      if (IsSupported(path)) return path;
    }
    return SimdPath::kPortable;
  }();
  return best;
}

const TileKernel& KernelOf(SimdPath path) {
  PLUMB_CHECK(IsSupported(path));
#if defined(__x86_64__)
  switch (path) {
    case SimdPath::kPortable:
      return PortableKernel();
    case SimdPath::kAvx2:
      return Avx2Kernel();
    case SimdPath::kAvxVnni:
      return AvxVnniKernel();
    case SimdPath::kAvx512Vnni:
      return Avx512VnniKernel();
  }
#endif
  return PortableKernel();
}

}  // namespace plumb::internal
