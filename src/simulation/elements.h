// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bricks, stones, boards, tiles: which element a place lies in, on the lanes of lanes.h.
#pragma once

#include "simulation/lanes.h"
#include "simulation/shade_job.h"

namespace plumb::internal {
namespace {

struct Element {
  U hash;      // Of the element.
  F du, dv;    // From its centre [m].
  F edge_u_m;  // To its nearest edges: negative in the joint.
  F edge_v_m;
};

enum class Bond { kRunning, kRandom, kStacked };

PLUMB_SIMD_INLINE Element ElementAt(const SurfaceShader& shader, Bond bond, F u, F v) {
  const float joint = shader.joint_m;
  const float pitch_u = shader.element_m[0] + joint;
  const float pitch_v = shader.element_m[1] + joint;
  const F row_place = v * (1.0F / pitch_v);
  const I row = Floor(row_place);
  const U row_hash = Scramble((U)row * 0x9E3779B1U + shader.seed);
  F shift = Splat(0.0F);
  if (bond == Bond::kRunning) shift = ToFloat(row & 1) * 0.5F + 0.04F * LowUnit(row_hash);
  if (bond == Bond::kRandom) shift = LowUnit(row_hash);
  const F column_place = u * (1.0F / pitch_u) + shift;
  const I column = Floor(column_place);

  Element element;
  element.hash = Scramble(row_hash ^ ((U)column * 0x85EBCA77U));
  element.du = (column_place - ToFloat(column) - 0.5F) * pitch_u;
  element.dv = (row_place - ToFloat(row) - 0.5F) * pitch_v;
  // No two are laid alike.
  element.du += 0.2F * joint * LowUnit(element.hash);
  element.dv += 0.15F * joint * HighUnit(element.hash) + element.du * 0.004F * LowUnit(row_hash);
  element.edge_u_m = 0.5F * shader.element_m[0] - Abs(element.du);
  element.edge_v_m = 0.5F * shader.element_m[1] - Abs(element.dv);
  return element;
}

// Share of a footprint of `size_m` that lies on the near side of an edge `distance_m` ahead.
PLUMB_SIMD_INLINE F Coverage(F distance_m, F size_m) { return Clamp01(distance_m / size_m + 0.5F); }

// 1 where the elements are large for a sample, 0 where they are too small to be told apart.
PLUMB_SIMD_INLINE F ResolvedShare(const SurfaceShader& shader, F size_m) {
  const float smaller =
      shader.element_m[0] < shader.element_m[1] ? shader.element_m[0] : shader.element_m[1];
  return SmoothStep(2.0F, 5.0F, (smaller + shader.joint_m) / size_m);
}

// Share of the surface that is not joint.
PLUMB_SIMD_INLINE float BodyShare(const SurfaceShader& shader) {
  return shader.element_m[0] * shader.element_m[1] /
         ((shader.element_m[0] + shader.joint_m) * (shader.element_m[1] + shader.joint_m));
}

// Change of the cosine with the sun where an element's border is bevelled.
PLUMB_SIMD_INLINE F Bevel(const SurfaceShader& shader, const Element& element, float width_m) {
  const F near_u = Clamp01(1.0F - element.edge_u_m * (1.0F / width_m));
  const F near_v = Clamp01(1.0F - element.edge_v_m * (1.0F / width_m));
  const F towards_u = element.du > 0.0F ? Splat(shader.sun_u) : Splat(-shader.sun_u);
  const F towards_v = element.dv > 0.0F ? Splat(shader.sun_v) : Splat(-shader.sun_v);
  return near_u * towards_u + near_v * towards_v;
}

}  // namespace
}  // namespace plumb::internal
