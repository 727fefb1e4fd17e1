// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "image/float_image.h"

namespace plumb {

// Where in a Gaussian image a feature lies.
struct PatchFrame {
  float x = 0.0F;  // Pixels of the image.
  float y = 0.0F;
  float sigma = 0.0F;  // Scale of the feature, in pixels of the image.
};

// The one or two dominant gradient directions, the strongest first, in (-pi, pi], from x towards y
// (Lowe, IJCV 2004, section 5). Deviation: gradients are sampled on a grid of 0.75 sigma rather
// than at each pixel; a Gaussian image of that sigma holds nothing finer.
std::vector<float> FindOrientations(const FloatImage& image, const PatchFrame& frame);

// Writes the RootSIFT descriptor of kDescriptorSize bytes (features.h). Cells of 3 sigma, 4 x 4
// of them by 8 directions (Lowe, section 6.1), sampled as above on a grid that turns with
// the feature, so that each sample's share in the cells is the same for all features.
void DescribePatch(const FloatImage& image,
                   const PatchFrame& frame,
                   float orientation_rad,
                   std::uint8_t* descriptor);

}  // namespace plumb
