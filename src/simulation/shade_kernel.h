// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/simd.h"
#include "simulation/shade_job.h"

namespace plumb::internal {

// The arithmetic of shading, compiled for one kind of processor. All give the same bits.
struct ShadeKernel {
  // Where on a patch the rays arrive.
  void (*find_texture)(const PatchView& view, const RayList& rays, const TextureList& texture);
  // The radiance of a facet.
  void (*shade)(const ShadeJob& job);
  // The radiance of the sky.
  void (*shade_sky)(const SkyJob& job);
};

const ShadeKernel& PortableShadeKernel();
#if defined(__x86_64__)
const ShadeKernel& Avx2ShadeKernel();
const ShadeKernel& Avx512ShadeKernel();
#endif

// `level` must be one that this processor has.
const ShadeKernel& ShadeKernelOf(SimdLevel level);

}  // namespace plumb::internal
