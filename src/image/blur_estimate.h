// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/scale_space.h"

namespace plumb {

// Sigma of the photo's blur, in full-resolution pixels, from how much its strong edges lose
// when blurred further (Zhuo & Sim, Defocus map estimation from a single image, Pattern
// Recognition 44(9), 2011, equation 5). Edges of each direction are judged apart, and the most
// blurred direction counts, for motion leaves the edges along it sharp. 0 without edges.
double EstimateBlur(const Octave& octave);

}  // namespace plumb
