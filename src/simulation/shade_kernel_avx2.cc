// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#if defined(__x86_64__)

// What is not the kernels' own is compiled for any processor, so before the target is set.
#include <array>
#include <cstdint>
#include <cstring>

#include "image/simd.h"
#include "plumbline/simulation/material.h"

#pragma GCC target("avx2")
#define PLUMB_LANES 8
#include "simulation/shade_lanes.h"

namespace plumb::internal {

const ShadeKernel& Avx2ShadeKernel() { return kShadeKernel; }

}  // namespace plumb::internal

#endif
