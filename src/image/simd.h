// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Vector code for several processors from one source: write the body as a
// PLUMB_SIMD_INLINE function and compile it into functions with one target each.
#define PLUMB_SIMD_INLINE inline __attribute__((always_inline))

#if defined(__x86_64__)
#define PLUMB_TARGET_AVX2 __attribute__((target("avx2,fma")))
#define PLUMB_TARGET_AVX512 \
  __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq,avx2,fma,prefer-vector-width=512")))
#endif

namespace plumb {

enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

// Of this processor.
inline SimdLevel DetectSimdLevel() {
#if defined(__x86_64__)
  static const SimdLevel level = [] {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
      return SimdLevel::kAvx512;
    }
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return has_avx2 ? SimdLevel::kAvx2 : SimdLevel::kBaseline;
  }();
  return level;
#else
  return SimdLevel::kBaseline;
#endif
}

}  // namespace plumb
