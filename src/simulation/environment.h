// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sky, what stands opposite, and the panes that mirror both, on the lanes of lanes.h.
#pragma once

#include "simulation/detail.h"

namespace plumb::internal {
namespace {

struct Direction {
  F x, y, z;  // Unit length.
};

PLUMB_SIMD_INLINE Direction Normalized(F x, F y, F z) {
  const F scale = 1.0F / Sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

// Pale at the horizon, blue above, with thin clouds; z is up. Radiance for a sky irradiance of 1.
PLUMB_SIMD_INLINE Rgb Sky(const Direction& towards) {
  const F height = Clamp01(towards.z);
  const F falloff = (1.0F - height) * (1.0F - height);
  const Rgb blue = SplatRgb(0.62F, 0.95F, 1.55F);
  const Rgb pale = SplatRgb(1.55F, 1.70F, 1.85F);
  // The clouds hang in a plane overhead.
  const F reach = 1.0F / (height + 0.15F);
  const F x = towards.x * reach;
  const F y = towards.y * reach;
  const F cloud = SmoothStep(0.2F,
                             2.8F,
                             Noise(1.3F * x, 0.8F * y, 11U).value +
                                 0.5F * Noise(3.1F * x, 2.3F * y, 12U).value +
                                 0.25F * Noise(7.3F * x, 5.9F * y, 13U).value);
  return Mix(Mix(blue, pale, falloff * falloff),
             SplatRgb(2.1F, 2.1F, 2.1F),
             0.7F * cloud * SmoothStep(0.0F, 0.2F, height));
}

// A row of houses across the street, 40 m off, in coordinates along and above the ground.
PLUMB_SIMD_INLINE Rgb Opposite(F along_m, F height_m, Rgb sky) {
  const F house_place = along_m * (1.0F / 13.0F);
  const I house = Floor(house_place);
  const U hash = Scramble((U)house * 0x9E3779B1U + 77U);
  const F top_m = 14.0F + 6.0F * LowUnit(hash);
  const F shade = 0.30F + 0.12F * HighUnit(hash);
  const F bay = along_m * (1.0F / 2.6F);
  const F storey = height_m * (1.0F / 3.2F);
  const F across = Abs(bay - ToFloat(Floor(bay)) - 0.5F);
  const F up = Abs(storey - ToFloat(Floor(storey)) - 0.5F);
  const F window = SmoothStep(0.24F, 0.2F, across) * SmoothStep(0.32F, 0.28F, up);
  const Rgb wall{shade, shade * 0.93F, shade * 0.82F};
  const Rgb house_color = Mix(wall, SplatRgb(0.07F, 0.08F, 0.10F), window);
  return Mix(sky, house_color, SmoothStep(0.15F, -0.15F, height_m - top_m));
}

}  // namespace
}  // namespace plumb::internal
