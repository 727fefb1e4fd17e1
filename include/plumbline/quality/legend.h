// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "plumbline/quality/gaps.h"
#include "plumbline/quality/layer.h"

namespace plumb {

constexpr int kLegendWidth_px = 900;
constexpr int kLegendHeight_px = 170;

// The colour scale of a layer with its values, dark on white; that of the GSD has a mark at the
// wanted one, and says so while the map is not metric. 8-bit RGB.
cv::Mat DrawLegend(Layer layer, Palette palette, const Measure& measure, const GapOptions& options);

}  // namespace plumb
