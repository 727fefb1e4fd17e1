// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/shade_kernel.h"

#define PLUMB_LANES 4
#include "plumbline/common/check.h"
#include "simulation/shade_lanes.h"

namespace plumb::internal {

const ShadeKernel& PortableShadeKernel() { return kShadeKernel; }

const ShadeKernel& ShadeKernelOf(SimdLevel level) {
  PLUMB_CHECK(level <= DetectSimdLevel());
#if defined(__x86_64__)
  if (level == SimdLevel::kAvx512) return Avx512ShadeKernel();
  if (level == SimdLevel::kAvx2) return Avx2ShadeKernel();
#endif
  return PortableShadeKernel();
}

}  // namespace plumb::internal
