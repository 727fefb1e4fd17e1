// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "image/simd.h"
#include "plumbline/simulation/material.h"

namespace plumb::internal {

// The lists below are as long as a multiple of this; what pads them is finite.
constexpr int kListAlignment = 16;

// One octave of gradient noise over texture coordinates: the lattice coordinates are
//   (x, y) = (x_by_u u + x_by_v v, y_by_u u + y_by_v v).
struct Octave {
  float x_by_u = 0.0F, x_by_v = 0.0F, y_by_u = 0.0F, y_by_v = 0.0F;
  float sun_x = 0.0F, sun_y = 0.0F;  // Change of (x, y) along the sun's direction in the surface.
  float wavelength_m = 1.0F;         // The shorter one.
  float tone = 0.0F;                 // Weight on reflectance.
  float relief = 0.0F;               // Weight on the slope towards the sun.
  std::uint32_t seed = 0;
};

constexpr int kMaxOctaves = 16;

// What the kernels need of a facet or plate, for one light.
struct SurfaceShader {
  Pattern pattern = Pattern::kPlaster;
  std::array<float, 3> reflectance{};
  float strength = 0.0F;    // Of all irregularity: 1 for a detail of 0.12.
  float per_detail = 0.0F;  // 1 / detail; 0 for none.
  std::array<float, 2> element_m{};
  float joint_m = 0.0F;
  float element_contrast = 0.0F;
  float specular = 0.0F;
  std::uint32_t seed = 0;
  std::array<Octave, kMaxOctaves> octaves;  // From coarse to fine.
  int num_octaves = 0;
  Octave contrast, warp, stain, streak, crack, crack_where, trowel;
  float height_by_u = 0.0F, height_by_v = 0.0F;  // World z = height + those . (u, v).
  float height_m = 0.0F;
  bool is_level = false;  // Ground, sills: nothing splashes against it.

  float sun_cosine = 0.0F;           // Of the sun's direction with the normal; below 0: dark.
  float sun_u = 0.0F, sun_v = 0.0F;  // The sun's direction along the texture's axes.
  std::array<float, 3> sun{};        // Irradiance at normal incidence.
  std::array<float, 3> ambient{};    // Irradiance where nothing hides the sky.

  float sky = 0.0F;                      // Irradiance.
  std::array<float, 9> axes_from_cam{};  // Rows: u axis, v axis, outward normal. For mirrors.
  std::array<float, 3> up_in_axes{};
};

// Where a patch's texture lies in a photo: with X = (x, y, 1) of the viewing ray,
//   u = u0 + (u . X) / (n . X),   v = v0 + (v . X) / (n . X).
struct PatchView {
  std::array<float, 3> n{}, u{}, v{};
  float u0 = 0.0F, v0 = 0.0F;
};

// Of the places that a pixel's mean is taken over: of place `index` of `count` along an axis, from
// the centre, in pitches.
PLUMB_SIMD_INLINE float OffsetOf(int index, int count) {
  return static_cast<float>(index) - 0.5F * static_cast<float>(count - 1);
}

// Rays (PixelRay) by component.
struct RayList {
  int count = 0;
  const float *x, *y, *x_by_column, *x_by_row, *y_by_column, *y_by_row;
};

// Texture coordinates and their change by pixel, [m] and [m/px].
struct TextureList {
  float *u, *v, *u_by_column, *u_by_row, *v_by_column, *v_by_row;
};

struct LightList {
  const float* sun;      // Share of the sun that is seen.
  const float* ambient;  // Share of the sky and ground that is seen.
  const float* run_off;  // 0..1: how much dirty water runs down here.
};

struct ColorList {
  float *red, *green, *blue;
};

struct ShadeJob {
  const SurfaceShader* shader;
  RayList rays;
  TextureList texture;
  LightList light;
  ColorList radiance;     // Out.
  int samples_per_axis;   // The means over so many places of each pixel's area, per axis.
  float sample_pitch_px;  // Between the places; 1 / samples_per_axis of the photo.
};

struct SkyJob {
  RayList rays;
  std::array<float, 9> world_from_cam;  // Row major.
  float sky;                            // Irradiance.
  ColorList radiance;                   // Out.
};

}  // namespace plumb::internal
