// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The looks of each pattern, on the lanes of lanes.h. A surface has two steps: Broad, once a pixel,
// for all that hardly changes within it, and At, for each sampled place.
#pragma once

#include "simulation/detail.h"
#include "simulation/elements.h"

namespace plumb::internal {
namespace {

struct Broad {
  Detail detail;  // Of the coarse octaves.
  F contrast;
  F clean;   // Share of light that weathering leaves.
  F tint;    // Warm or cold.
  F blotch;  // The noise of the stains' size, deviation 1.
};

struct Sample {
  F u, v;
  F size_m;       // Of the footprint of the sample.
  Detail detail;  // All octaves, contrast included.
};

struct Looks {
  Rgb reflectance;
  F relief;  // Change of the cosine with the sun.
};

PLUMB_SIMD_INLINE Rgb Paint(const SurfaceShader& shader, const Broad& broad, F tone) {
  // Never black: what is darker by a half has half, not none.
  const F value = broad.clean * (tone < 0.0F ? 1.0F / (1.0F - tone) : 1.0F + tone);
  return {value * shader.reflectance[0] * (1.0F + broad.tint),
          value * shader.reflectance[1],
          value * shader.reflectance[2] * (1.0F - broad.tint)};
}

PLUMB_SIMD_INLINE Broad BroadOf(const SurfaceShader& shader, const Place& place, int num_coarse) {
  Broad broad;
  broad.blotch = Noise(shader.warp, place.u, place.v).value;
  broad.contrast = ContrastAt(shader, place.u, place.v, broad.blotch);
  broad.detail = SumOctaves(shader, 0, num_coarse, place.u, place.v, place.pixel_m);
  broad.clean = Weathering(shader, place, broad.contrast);
  broad.tint = 0.02F * shader.strength * broad.blotch;
  return broad;
}

struct Plaster {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    Broad broad = BroadOf(shader, place, num_coarse);
    // The strokes of the trowel bend with the noise that warps them.
    const F bend = 0.1F * Noise(shader.stain, place.u, place.v).value;
    const NoiseSample stroke = Noise(shader.trowel, place.u + bend, place.v - bend);
    const F weight = WeightOf(shader.trowel.wavelength_m, place.pixel_m);
    broad.detail.relief += weight * shader.trowel.relief * stroke.slope;
    broad.detail.tone += weight * shader.trowel.tone * stroke.value;
    broad.clean *= Cracks(shader, place, broad.detail.tone);
    return broad;
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    return {Paint(shader, broad, sample.detail.tone), sample.detail.relief};
  }
};

// An element's own reflectance, and its body against the joint.
PLUMB_SIMD_INLINE Looks Masonry(const SurfaceShader& shader,
                                const Broad& broad,
                                const Sample& sample,
                                const Element& element,
                                float bevel_m,
                                float mortar) {
  const F resolved = ResolvedShare(shader, sample.size_m);
  const F own = 1.4F * shader.element_contrast * resolved * LowUnit(element.hash);
  const F warm = 0.35F * shader.element_contrast * resolved * HighUnit(element.hash);
  const Rgb body = Paint(shader, broad, sample.detail.tone + own);
  const Rgb tinted{body.red * (1.0F + warm), body.green, body.blue * (1.0F - warm)};
  // Mortar is greyer than what it joins.
  const float grey = mortar * (shader.reflectance[0] + shader.reflectance[1]) * 0.5F;
  const F joint_tone = broad.clean * grey * Max(1.0F + sample.detail.tone, Splat(0.2F));
  const Rgb joint{joint_tone * 1.06F, joint_tone, joint_tone * 0.86F};

  const F chip = bevel_m * 0.5F * Min(shader.per_detail * sample.detail.tone + 0.5F, Splat(0.7F));
  const F edge = Min(element.edge_u_m, element.edge_v_m);
  const F cover = Mix(Splat(BodyShare(shader)), Coverage(edge + chip, sample.size_m), resolved);
  const F bevel_share = resolved * Min(bevel_m / sample.size_m, Splat(1.0F));
  const F bevel = 0.6F * bevel_share * Bevel(shader, element, bevel_m);
  // The joint lies deeper: the stone above shades it.
  const F depth = 0.25F * (1.0F - cover) * (element.dv > 0.0F ? Splat(0.4F) : Splat(1.0F));
  return {Mix(joint, tinted, cover), Mix(-depth, sample.detail.relief + bevel, cover)};
}

struct Brick {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    return BroadOf(shader, place, num_coarse);
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    const Element element = ElementAt(shader, Bond::kRunning, sample.u, sample.v);
    return Masonry(shader, broad, sample, element, 0.004F, 1.1F);
  }
};

struct Ashlar {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    Broad broad = BroadOf(shader, place, num_coarse);
    broad.clean *= Cracks(shader, place, broad.detail.tone);
    return broad;
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    const Element element = ElementAt(shader, Bond::kRandom, sample.u, sample.v);
    return Masonry(shader, broad, sample, element, 0.012F, 0.6F);
  }
};

// Asphalt, gravel, grass: rough, without elements.
struct Ground {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    return BroadOf(shader, place, num_coarse);
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    return {Paint(shader, broad, sample.detail.tone), 2.0F * sample.detail.relief};
  }
};

// Painted boards; the paint has peeled here and there.
struct Wood {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    return BroadOf(shader, place, num_coarse);
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    const Element board = ElementAt(shader, Bond::kStacked, sample.u, sample.v);
    const F offset = 3.0F * LowUnit(board.hash);
    const NoiseSample grain = Noise(shader.trowel, sample.u + offset, sample.v + offset);
    const F weight = WeightOf(shader.trowel.wavelength_m, sample.size_m * 2.0F);
    const F own = shader.element_contrast * HighUnit(board.hash);
    const F tone = sample.detail.tone + own + weight * shader.trowel.tone * grain.value;
    const Rgb paint = Paint(shader, broad, tone);
    const Rgb bare = SplatRgb(0.30F, 0.24F, 0.18F) * Max(1.0F + tone, Splat(0.1F));
    const F scatter = 0.8F * shader.per_detail * sample.detail.tone;
    const F peeled = SmoothStep(2.1F, 2.4F, broad.blotch - scatter);
    const F gap = shader.joint_m > 0.0F
                      ? Coverage(Min(board.edge_u_m, board.edge_v_m), sample.size_m)
                      : Splat(1.0F);
    const Rgb wood = Mix(paint, bare, Min(peeled * shader.strength, Splat(1.0F)));
    return {wood * Mix(Splat(0.3F), Splat(1.0F), gap),
            sample.detail.relief + weight * shader.trowel.relief * grain.slope +
                0.3F * Bevel(shader, board, 0.004F)};
  }
};

// Painted or bare sheet: smooth, with drips and spots of rust.
struct Metal {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    Broad broad = BroadOf(shader, place, num_coarse);
    const F drip = SmoothStep(0.2F, 2.0F, Noise(shader.streak, place.u, place.v).value);
    broad.clean *= 1.0F - 0.15F * shader.strength * drip;
    return broad;
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    const Rgb paint = Paint(shader, broad, 0.5F * sample.detail.tone);
    const Rgb rust = SplatRgb(0.22F, 0.10F, 0.05F) * (1.0F + 2.0F * sample.detail.tone);
    const F scatter = 0.8F * shader.per_detail * sample.detail.tone;
    const F rusty = SmoothStep(2.4F, 2.8F, broad.blotch + scatter);
    return {Mix(paint, rust, Min(rusty * shader.strength, Splat(1.0F))),
            0.4F * sample.detail.relief};
  }
};

struct RoofTiles {
  static PLUMB_SIMD_INLINE Broad BroadAt(const SurfaceShader& shader,
                                         const Place& place,
                                         int num_coarse) {
    return BroadOf(shader, place, num_coarse);
  }
  static PLUMB_SIMD_INLINE Looks At(const SurfaceShader& shader,
                                    const Broad& broad,
                                    const Sample& sample) {
    const Element tile = ElementAt(shader, Bond::kStacked, sample.u, sample.v);
    const F resolved = ResolvedShare(shader, sample.size_m);
    const F own = 1.7F * shader.element_contrast * resolved * LowUnit(tile.hash);
    const Rgb clay = Paint(shader, broad, sample.detail.tone + own);
    const Rgb lichen = SplatRgb(0.45F, 0.44F, 0.30F) * (1.0F + sample.detail.tone);
    const F scatter = 0.8F * shader.per_detail * sample.detail.tone;
    const F grown = SmoothStep(2.2F, 2.6F, broad.blotch + scatter);
    // Each tile is an arch, and casts a shadow below its lower edge.
    const F arch = tile.du * (2.0F / shader.element_m[0]);
    const F shade =
        SmoothStep(0.0F, 0.02F, tile.edge_v_m + (tile.dv > 0.0F ? Splat(0.0F) : Splat(0.02F)));
    const F gap = Coverage(Min(tile.edge_u_m, tile.edge_v_m), sample.size_m);
    const F light = Mix(Splat(0.9F),
                        Mix(Splat(0.25F), Splat(1.0F), shade) * Mix(Splat(0.3F), Splat(1.0F), gap),
                        resolved);
    return {Mix(clay, lichen, 0.6F * grown * Min(Splat(shader.strength), Splat(1.0F))) * light,
            sample.detail.relief + 0.5F * resolved * arch * shader.sun_u};
  }
};

}  // namespace
}  // namespace plumb::internal
