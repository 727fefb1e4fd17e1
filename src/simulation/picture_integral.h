// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/simulation/world.h"

namespace plumb::internal {

// Exact means of a plate's picture, whose pixels are squares of one reflectance, over rectangles.
class PictureIntegral {
 public:
  // `picture` null: white.
  explicit PictureIntegral(const PlatePicture* picture);

  // Mean reflectance over the rectangle of the given centre and sides, in shares of the plate's
  // side, (0, 0) its upper left corner. Beyond the border the border goes on.
  float Mean(float x, float y, float width, float height) const;

 private:
  double IntegralTo(double x, double y) const;  // From the corner, in pixels.

  int side_px_ = 1;
  std::vector<double> sums_;  // (side + 1)^2; sums_[r][c] of the rows and columns before.
};

}  // namespace plumb::internal
