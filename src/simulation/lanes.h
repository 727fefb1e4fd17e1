// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of PLUMB_LANES numbers for the shading kernels. Each source that includes this compiles
// it for its own processor, so all is local to the source. Only operations that IEEE 754
// rounds exactly are used, and none is contracted (cmake/core.cmake): all processors agree to
// the bit.
#pragma once

#include <cstdint>
#include <cstring>

#include "image/simd.h"

namespace plumb::internal {
namespace {

constexpr int kLanes = PLUMB_LANES;
typedef float F __attribute__((vector_size(PLUMB_LANES * 4)));          // NOLINT
typedef std::int32_t I __attribute__((vector_size(PLUMB_LANES * 4)));   // NOLINT
typedef std::uint32_t U __attribute__((vector_size(PLUMB_LANES * 4)));  // NOLINT

PLUMB_SIMD_INLINE F Splat(float value) { return F{} + value; }
PLUMB_SIMD_INLINE F Load(const float* values) {
  F result;
  std::memcpy(&result, values, sizeof(result));
  return result;
}
PLUMB_SIMD_INLINE void Store(F values, float* target) {
  std::memcpy(target, &values, sizeof(values));
}

PLUMB_SIMD_INLINE F ToFloat(I values) { return __builtin_convertvector(values, F); }
PLUMB_SIMD_INLINE I Floor(F values) {
  const I truncated = __builtin_convertvector(values, I);
  return truncated + (I)(ToFloat(truncated) > values);  // A true lane is -1.
}

PLUMB_SIMD_INLINE F Min(F a, F b) { return a < b ? a : b; }
PLUMB_SIMD_INLINE F Max(F a, F b) { return a > b ? a : b; }
PLUMB_SIMD_INLINE F Abs(F a) { return a < 0.0F ? -a : a; }
PLUMB_SIMD_INLINE F Clamp01(F a) { return Min(Max(a, Splat(0.0F)), Splat(1.0F)); }
PLUMB_SIMD_INLINE F Mix(F a, F b, F share_of_b) { return a + share_of_b * (b - a); }

// 0 below `low`, 1 above `high`, smooth between.
PLUMB_SIMD_INLINE F SmoothStep(float low, float high, F value) {
  const F t = Clamp01((value - low) * (1.0F / (high - low)));
  return t * t * (3.0F - 2.0F * t);
}

PLUMB_SIMD_INLINE F Sqrt(F values) {
  for (int i = 0; i < kLanes; ++i) values[i] = __builtin_sqrtf(values[i]);
  return values;
}

PLUMB_SIMD_INLINE bool AnyPositive(F values) {
  const I positive = (I)(values > 0.0F);
  std::uint64_t words[kLanes / 2];
  std::memcpy(words, &positive, sizeof(positive));
  std::uint64_t any = 0;
  for (const std::uint64_t word : words) any |= word;
  return any != 0;
}

PLUMB_SIMD_INLINE U Scramble(U hash) {
  hash ^= hash >> 15;
  hash *= 0x2C1B3C6DU;
  hash ^= hash >> 13;
  return hash;
}

// In [-1, 1), from the low or the high half of a hash.
PLUMB_SIMD_INLINE F LowUnit(U hash) { return ToFloat((I)(hash << 16)) * (1.0F / 2147483648.0F); }
PLUMB_SIMD_INLINE F HighUnit(U hash) { return ToFloat((I)hash) * (1.0F / 2147483648.0F); }

struct Rgb {
  F red, green, blue;
};
PLUMB_SIMD_INLINE Rgb operator*(Rgb color, F factor) {
  return {color.red * factor, color.green * factor, color.blue * factor};
}
PLUMB_SIMD_INLINE Rgb operator+(Rgb a, Rgb b) {
  return {a.red + b.red, a.green + b.green, a.blue + b.blue};
}
PLUMB_SIMD_INLINE Rgb Mix(Rgb a, Rgb b, F share_of_b) {
  return {Mix(a.red, b.red, share_of_b),
          Mix(a.green, b.green, share_of_b),
          Mix(a.blue, b.blue, share_of_b)};
}
PLUMB_SIMD_INLINE Rgb SplatRgb(float red, float green, float blue) {
  return {Splat(red), Splat(green), Splat(blue)};
}

}  // namespace
}  // namespace plumb::internal
