// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "image/extrema.h"
#include "image/photo_raster.h"

namespace plumb {

// Indices of at most `max_count` of the extrema, best first: the largest scales, but no
// part of the photo gets more than its share while smaller ones elsewhere are left. The photo
// is cut into about kSelectionCells square cells; each cell's extrema, from large to small, fall
// into tiers of twice the mean share, and tiers are served in order, each from large to small.
std::vector<int> SelectExtrema(const std::vector<Extremum>& extrema,
                               const std::vector<Octave>& octaves,
                               PhotoSize size,
                               int max_count);

}  // namespace plumb
