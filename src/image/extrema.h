// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "image/scale_space.h"
#include "plumbline/image/feature_options.h"

namespace plumb {

// An extremum of the difference of Gaussians.
struct Extremum {
  int octave_idx = 0;
  float x = 0.0F;  // Pixels of the octave.
  float y = 0.0F;
  float level = 0.0F;     // Of the octave; refined, so fractional.
  float scale_px = 0.0F;  // Sigma in full-resolution pixels.
};

// All extrema of one octave that pass the bounds on contrast and edges, refined
// to a fraction of a pixel and of a level (Lowe, IJCV 2004, sections 3.1, 4 and 4.1). Row by row.
std::vector<Extremum> FindExtrema(const FeatureOptions& options,
                                  const Octave& octave,
                                  int octave_idx);

}  // namespace plumb
