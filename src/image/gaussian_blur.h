// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/float_image.h"

namespace plumb {

// `image` convolved with a Gaussian of `sigma_px`, cut at 4 sigma; the border
// pixel is repeated outwards. The result's padding is filled.
FloatImage BlurGaussian(const FloatImage& image, double sigma_px, int num_threads);

}  // namespace plumb
