// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The irregular detail that all patterns share, on the lanes of lanes.h.
#pragma once

#include "simulation/noise.h"

namespace plumb::internal {
namespace {

// Octaves finer than this are not in a photo: none below the first [px], all above the second.
constexpr float kFadeOutPx = 1.2F;
constexpr float kFadeInPx = 2.4F;

// Coarser octaves hardly change within a pixel: once a pixel will do.
constexpr float kOncePerPixelPx = 7.0F;

// A place on a surface, and the pixel that sees it.
struct Place {
  F u, v;
  F pixel_m;   // The longer side of the pixel's footprint.
  F height_m;  // Of the place, world z.
  F run_off;
};

struct Detail {
  F tone;    // Relative change of reflectance; deviation: the material's detail.
  F relief;  // Change of the cosine with the sun.
};

PLUMB_SIMD_INLINE F WeightOf(float wavelength_m, F pixel_m) {
  return SmoothStep(kFadeOutPx, kFadeInPx, wavelength_m / pixel_m);
}

// Dark pits: the lower tail of the noise goes deeper.
PLUMB_SIMD_INLINE F WithPits(F noise) { return noise + 1.6F * Min(noise + 1.3F, Splat(0.0F)); }

PLUMB_SIMD_INLINE void AddOctave(const Octave& octave, F u, F v, F weight, Detail* detail) {
  const NoiseSample noise = Noise(octave, u, v);
  detail->tone += weight * octave.tone * WithPits(noise.value);
  detail->relief += weight * octave.relief * noise.slope;
}

// The octaves [first, last) of the shader.
PLUMB_SIMD_INLINE Detail
SumOctaves(const SurfaceShader& shader, int first, int last, F u, F v, F pixel_m) {
  Detail detail{Splat(0.0F), Splat(0.0F)};
  for (int k = first; k < last; ++k) {
    const F weight = WeightOf(shader.octaves[k].wavelength_m, pixel_m);
    if (!AnyPositive(weight)) continue;
    AddOctave(shader.octaves[k], u, v, weight, &detail);
  }
  return detail;
}

// How lively the fine detail is here, 0.4 to 2.
PLUMB_SIMD_INLINE F ContrastAt(const SurfaceShader& shader, F u, F v, F blotch) {
  const F level = Noise(shader.contrast, u, v).value + 0.3F * blotch;
  return 0.4F + 1.6F * SmoothStep(-1.0F, 2.2F, level);
}

// The share of light that stains, run-off and splashes from the ground leave.
PLUMB_SIMD_INLINE F Weathering(const SurfaceShader& shader, const Place& place, F contrast) {
  const F strength = Min(Splat(shader.strength), Splat(1.3F));
  F clean = Splat(1.0F);
  const F stain = SmoothStep(0.4F, 2.0F, Noise(shader.stain, place.u, place.v).value);
  clean -= 0.13F * strength * stain;
  if (AnyPositive(place.run_off)) {
    // Here more, there less, as the ledge is worn.
    const F streak =
        SmoothStep(-0.2F, 2.4F, Noise(shader.streak, place.u, place.v).value + contrast - 0.9F);
    clean *= 1.0F - 0.34F * strength * place.run_off * streak;
  }
  if (shader.is_level) return clean;
  const F splash = Clamp01(1.0F - place.height_m * (1.0F / 0.7F));
  return clean * (1.0F - 0.2F * strength * splash * splash * contrast);
}

// The share of light that hairline cracks leave: the zero lines of a noise, where another is high.
PLUMB_SIMD_INLINE F Cracks(const SurfaceShader& shader, const Place& place, F bend) {
  constexpr float kWidth_m = 0.0007F;
  const F where = SmoothStep(0.9F, 1.3F, Noise(shader.crack_where, place.u, place.v).value);
  if (!AnyPositive(where)) return Splat(1.0F);
  const F level = Noise(shader.crack, place.u, place.v).value + 2.0F * bend;
  // The noise rises by about 1.5 in a wavelength of the lattice.
  const F distance_m = Abs(level) * (shader.crack.wavelength_m * 0.6F);
  const F reach_m = kWidth_m + 0.6F * place.pixel_m;
  const F profile = Clamp01(1.0F - distance_m / reach_m) * (kWidth_m / reach_m);
  return 1.0F - Min(1.1F * where * profile, Splat(0.85F));
}

}  // namespace
}  // namespace plumb::internal
