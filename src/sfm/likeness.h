// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace plumb {

// Squared distance of 8-bit RootSIFT (norm 512) above which two features are not taken for
// the same even where geometry puts them in one place.
constexpr std::int32_t kMaxSquaredDistance = 240 * 240;

// A landmark's feature size grows as the camera comes nearer; SIFT finds it within this factor.
constexpr double kMaxScaleRatio = 1.6;

inline bool IsScaleAlike(double scale1_px, double scale2_px) {
  return scale1_px <= kMaxScaleRatio * scale2_px && scale2_px <= kMaxScaleRatio * scale1_px;
}

}  // namespace plumb
