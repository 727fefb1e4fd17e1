// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradient noise on the lanes of lanes.h.
#pragma once

#include "simulation/lanes.h"
#include "simulation/shade_job.h"

namespace plumb::internal {
namespace {

struct NoiseSample {
  F value;  // Standard deviation 1, mean 0.
  F slope;  // Its derivative along (sun_x, sun_y), of deviation 2.9 for unit vectors.
};

// The random gradients' length makes the value's standard deviation 1.
constexpr float kGradientScale = 5.66F / 2147483648.0F;

struct Corner {
  F value;
  F slope;
};

PLUMB_SIMD_INLINE Corner CornerOf(U hash, F x, F y, float sun_x, float sun_y) {
  const U mixed = Scramble(hash);
  const F gradient_x = ToFloat((I)(mixed << 16)) * kGradientScale;
  const F gradient_y = ToFloat((I)mixed) * kGradientScale;
  return {gradient_x * x + gradient_y * y, gradient_x * sun_x + gradient_y * sun_y};
}

// Ken Perlin, "Improving noise", 2002, in the plane, with gradients of random length: real
// surfaces are not equally lively everywhere.
PLUMB_SIMD_INLINE NoiseSample
Noise(F x, F y, std::uint32_t seed, float sun_x = 0.0F, float sun_y = 0.0F) {
  const I column = Floor(x);
  const I row = Floor(y);
  const F fx = x - ToFloat(column);
  const F fy = y - ToFloat(row);
  const U column_hash = (U)column * 0x9E3779B1U + seed;
  const U row_hash = (U)row * 0x85EBCA77U;
  const U next_column_hash = column_hash + 0x9E3779B1U;
  const U next_row_hash = row_hash + 0x85EBCA77U;
  const Corner c00 = CornerOf(column_hash ^ row_hash, fx, fy, sun_x, sun_y);
  const Corner c10 = CornerOf(next_column_hash ^ row_hash, fx - 1.0F, fy, sun_x, sun_y);
  const Corner c01 = CornerOf(column_hash ^ next_row_hash, fx, fy - 1.0F, sun_x, sun_y);
  const Corner c11 = CornerOf(next_column_hash ^ next_row_hash, fx - 1.0F, fy - 1.0F, sun_x, sun_y);

  const F sx = fx * fx * fx * (fx * (fx * 6.0F - 15.0F) + 10.0F);
  const F sy = fy * fy * fy * (fy * (fy * 6.0F - 15.0F) + 10.0F);
  const F sx_slope = 30.0F * sun_x * fx * fx * (fx * (fx - 2.0F) + 1.0F);
  const F sy_slope = 30.0F * sun_y * fy * fy * (fy * (fy - 2.0F) + 1.0F);
  const F step0 = c10.value - c00.value;
  const F step1 = c11.value - c01.value;
  const F low = c00.value + sx * step0;
  const F high = c01.value + sx * step1;
  const F low_slope = Mix(c00.slope, c10.slope, sx);
  const F high_slope = Mix(c01.slope, c11.slope, sx);
  return {
      low + sy * (high - low),
      Mix(low_slope, high_slope, sy) + sx_slope * Mix(step0, step1, sy) + sy_slope * (high - low)};
}

PLUMB_SIMD_INLINE NoiseSample Noise(const Octave& octave, F u, F v) {
  return Noise(octave.x_by_u * u + octave.x_by_v * v,
               octave.y_by_u * u + octave.y_by_v * v,
               octave.seed,
               octave.sun_x,
               octave.sun_y);
}

}  // namespace
}  // namespace plumb::internal
