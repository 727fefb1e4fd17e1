// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "marker/gray_sampler.h"
#include "plumbline/marker/ellipse.h"

namespace plumb {

struct EdgeSearch {
  double reach_px = 3.0;       // To both sides of the ellipse.
  double min_step = 5.0;       // Least rise of the grey values over a pixel [grey levels].
  bool is_dark_inside = true;  // Or bright inside.
  double min_share = 0.6;      // Of the directions, that must show an edge on the ellipse.
};

// The ellipse through the sub-pixel edge points near a known one: along rays from the centre the
// steepest rise is found, placed by the centroid of the slope, and an ellipse fitted to those
// that agree. Nothing if too few agree or the search leaves the image.
std::optional<Ellipse> RefineEllipse(const GraySampler& gray,
                                     const Ellipse& ellipse,
                                     const EdgeSearch& search);

}  // namespace plumb
