// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loops over rays, on the lanes of lanes.h. Included once by each source of a processor.
#pragma once

#include "simulation/environment.h"
#include "simulation/shade_kernel.h"
#include "simulation/surfaces.h"

namespace plumb::internal {
namespace {

PLUMB_SIMD_INLINE F Dot(const std::array<float, 3>& row, F x, F y) {
  return row[0] * x + row[1] * y + row[2];
}

void FindTexture(const PatchView& view, const RayList& rays, const TextureList& texture) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const F x = Load(rays.x + i);
    const F y = Load(rays.y + i);
    const F scale = 1.0F / Dot(view.n, x, y);
    const F u = Dot(view.u, x, y) * scale;
    const F v = Dot(view.v, x, y) * scale;
    Store(u + view.u0, texture.u + i);
    Store(v + view.v0, texture.v + i);
    // d(u . X / n . X) = (d(u . X) - (u . X / n . X) d(n . X)) / n . X.
    const F u_by_x = (view.u[0] - u * view.n[0]) * scale;
    const F u_by_y = (view.u[1] - u * view.n[1]) * scale;
    const F v_by_x = (view.v[0] - v * view.n[0]) * scale;
    const F v_by_y = (view.v[1] - v * view.n[1]) * scale;
    const F x_by_column = Load(rays.x_by_column + i);
    const F x_by_row = Load(rays.x_by_row + i);
    const F y_by_column = Load(rays.y_by_column + i);
    const F y_by_row = Load(rays.y_by_row + i);
    Store(u_by_x * x_by_column + u_by_y * y_by_column, texture.u_by_column + i);
    Store(u_by_x * x_by_row + u_by_y * y_by_row, texture.u_by_row + i);
    Store(v_by_x * x_by_column + v_by_y * y_by_column, texture.v_by_column + i);
    Store(v_by_x * x_by_row + v_by_y * y_by_row, texture.v_by_row + i);
  }
}

struct Spread {
  F u_by_column, u_by_row, v_by_column, v_by_row;
};

PLUMB_SIMD_INLINE Spread SpreadAt(const TextureList& texture, int i) {
  return {Load(texture.u_by_column + i),
          Load(texture.u_by_row + i),
          Load(texture.v_by_column + i),
          Load(texture.v_by_row + i)};
}

PLUMB_SIMD_INLINE F LongerSide(const Spread& spread) {
  const F column =
      spread.u_by_column * spread.u_by_column + spread.v_by_column * spread.v_by_column;
  const F row = spread.u_by_row * spread.u_by_row + spread.v_by_row * spread.v_by_row;
  return Sqrt(Max(column, row));
}

// The longest side of all, for a decision that must not depend on the number of lanes.
float LongestSide(const ShadeJob& job) {
  F longest = Splat(0.0F);
  for (int i = 0; i < job.rays.count; i += kLanes) {
    longest = Max(longest, LongerSide(SpreadAt(job.texture, i)));
  }
  float result = 0.0F;
  for (int lane = 0; lane < kLanes; ++lane)
    result = longest[lane] > result ? longest[lane] : result;
  return result;
}

int NumCoarseOctaves(const SurfaceShader& shader, float pixel_m) {
  int count = 0;
  while (count < shader.num_octaves &&
         shader.octaves[count].wavelength_m > kOncePerPixelPx * pixel_m) {
    ++count;
  }
  return count;
}

PLUMB_SIMD_INLINE Rgb Lit(const SurfaceShader& shader, const Looks& looks, F sun, F ambient) {
  const F cosine = sun * Max(shader.sun_cosine + looks.relief, Splat(0.0F));
  const F around = ambient * (1.0F + 0.3F * looks.relief);
  return {looks.reflectance.red * (shader.sun[0] * cosine + shader.ambient[0] * around),
          looks.reflectance.green * (shader.sun[1] * cosine + shader.ambient[1] * around),
          looks.reflectance.blue * (shader.sun[2] * cosine + shader.ambient[2] * around)};
}

PLUMB_SIMD_INLINE void StoreRgb(const Rgb& color, const ColorList& target, int i) {
  Store(color.red, target.red + i);
  Store(color.green, target.green + i);
  Store(color.blue, target.blue + i);
}

template <typename Surface>
void ShadeSurface(const ShadeJob& job) {
  const SurfaceShader& shader = *job.shader;
  const int num_coarse = NumCoarseOctaves(shader, LongestSide(job));
  const int n = job.samples_per_axis;
  for (int i = 0; i < job.rays.count; i += kLanes) {
    const Spread spread = SpreadAt(job.texture, i);
    Place place;
    place.u = Load(job.texture.u + i);
    place.v = Load(job.texture.v + i);
    place.pixel_m = LongerSide(spread);
    place.height_m = shader.height_m + shader.height_by_u * place.u + shader.height_by_v * place.v;
    place.run_off = Load(job.light.run_off + i);
    const F sun = shader.sun_cosine > 0.0F ? Load(job.light.sun + i) : Splat(0.0F);
    const F ambient = Load(job.light.ambient + i);
    const Broad broad = Surface::BroadAt(shader, place, num_coarse);

    Rgb sum = SplatRgb(0.0F, 0.0F, 0.0F);
    for (int k = 0; k < n * n; ++k) {
      const int row_index = k / n;
      const float column = job.sample_pitch_px * OffsetOf(k % n, n);
      const float row = job.sample_pitch_px * OffsetOf(row_index, n);
      Sample sample;
      sample.u = place.u + column * spread.u_by_column + row * spread.u_by_row;
      sample.v = place.v + column * spread.v_by_column + row * spread.v_by_row;
      sample.size_m = place.pixel_m * job.sample_pitch_px;
      const Detail fine =
          SumOctaves(shader, num_coarse, shader.num_octaves, sample.u, sample.v, place.pixel_m);
      sample.detail.tone = broad.contrast * fine.tone + broad.detail.tone;
      sample.detail.relief = broad.contrast * fine.relief + broad.detail.relief;
      sum = sum + Lit(shader, Surface::At(shader, broad, sample), sun, ambient);
    }
    StoreRgb(sum * Splat(1.0F / static_cast<float>(n * n)), job.radiance, i);
  }
}

// A pane: a dark room with a curtain behind, and the world opposite mirrored in it.
void ShadeGlass(const ShadeJob& job) {
  const SurfaceShader& shader = *job.shader;
  const std::array<float, 9>& axes = shader.axes_from_cam;
  for (int i = 0; i < job.rays.count; i += kLanes) {
    const F x = Load(job.rays.x + i);
    const F y = Load(job.rays.y + i);
    const F u = Load(job.texture.u + i);
    const F v = Load(job.texture.v + i);
    const Direction view = Normalized(axes[0] * x + axes[1] * y + axes[2],
                                      axes[3] * x + axes[4] * y + axes[5],
                                      axes[6] * x + axes[7] * y + axes[8]);
    // Old panes are wavy.
    const NoiseSample wave = Noise(shader.trowel, u, v);
    const F tilt = 0.0008F * shader.strength * wave.value;
    const Direction mirrored{view.x + 2.0F * tilt, view.y + 2.0F * tilt, Abs(view.z)};
    const F up = mirrored.x * shader.up_in_axes[0] + mirrored.y * shader.up_in_axes[1] +
                 mirrored.z * shader.up_in_axes[2];
    const Rgb sky = Sky({mirrored.x, mirrored.z, up}) * Splat(shader.sky);
    const F reach_m = 40.0F / Max(mirrored.z, Splat(0.02F));
    const F height = shader.height_m + shader.height_by_u * u + shader.height_by_v * v;
    const Rgb opposite = Opposite(u + reach_m * mirrored.x, height + reach_m * up, sky);

    const F facing = Clamp01(Abs(view.z));
    const F grazing = (1.0F - facing) * (1.0F - facing);
    const F mirrors =
        shader.specular + (1.0F - shader.specular) * grazing * grazing * (1.0F - facing);
    const F ambient = Load(job.light.ambient + i);
    const F folds = 0.75F + 0.25F * Noise(shader.streak, u, v).value;
    const F dust = 1.0F + 0.3F * shader.strength * Noise(shader.stain, u, v).value;
    const F room = folds * dust * (0.35F * ambient + 0.15F * Load(job.light.sun + i));
    const Rgb behind{
        room * shader.reflectance[0], room * shader.reflectance[1], room * shader.reflectance[2]};
    StoreRgb(Mix(behind, opposite, mirrors), job.radiance, i);
  }
}

void Shade(const ShadeJob& job) {
  switch (job.shader->pattern) {
    case Pattern::kPlaster:
      return ShadeSurface<Plaster>(job);
    case Pattern::kBrick:
      return ShadeSurface<Brick>(job);
    case Pattern::kAshlar:
      return ShadeSurface<Ashlar>(job);
    case Pattern::kWood:
      return ShadeSurface<Wood>(job);
    case Pattern::kGlass:
      return ShadeGlass(job);
    case Pattern::kMetal:
      return ShadeSurface<Metal>(job);
    case Pattern::kRoofTiles:
      return ShadeSurface<RoofTiles>(job);
    case Pattern::kGround:
      return ShadeSurface<Ground>(job);
  }
}

void ShadeSky(const SkyJob& job) {
  const std::array<float, 9>& world = job.world_from_cam;
  for (int i = 0; i < job.rays.count; i += kLanes) {
    const F x = Load(job.rays.x + i);
    const F y = Load(job.rays.y + i);
    const Direction towards = Normalized(world[0] * x + world[1] * y + world[2],
                                         world[3] * x + world[4] * y + world[5],
                                         world[6] * x + world[7] * y + world[8]);
    StoreRgb(Sky(towards) * Splat(job.sky), job.radiance, i);
  }
}

constexpr ShadeKernel kShadeKernel{&FindTexture, &Shade, &ShadeSky};

}  // namespace
}  // namespace plumb::internal
