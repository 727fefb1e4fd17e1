// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/picture_integral.h"

#include <algorithm>
#include <cmath>

namespace plumb::internal {

PictureIntegral::PictureIntegral(const PlatePicture* picture)
    : side_px_(picture == nullptr ? 1 : picture->side_px) {
  const int stride = side_px_ + 1;
  sums_.assign(static_cast<std::size_t>(stride) * stride, 0.0);
  for (int row = 0; row < side_px_; ++row) {
    double sum = 0.0;
    for (int column = 0; column < side_px_; ++column) {
      const double value =
          picture == nullptr ? 1.0 : picture->pixels[row * side_px_ + column] / 255.0;
      sum += value;
      sums_[(row + 1) * stride + column + 1] = sums_[row * stride + column + 1] + sum;
    }
  }
}

// Bilinear between the corners, as the picture is constant within a pixel.
double PictureIntegral::IntegralTo(double x, double y) const {
  const int column = std::min(static_cast<int>(x), side_px_ - 1);
  const int row = std::min(static_cast<int>(y), side_px_ - 1);
  const double fx = x - column;
  const double fy = y - row;
  const double* corner = &sums_[static_cast<std::size_t>(row) * (side_px_ + 1) + column];
  const double* next = corner + side_px_ + 1;
  return (1.0 - fy) * ((1.0 - fx) * corner[0] + fx * corner[1]) +
         fy * ((1.0 - fx) * next[0] + fx * next[1]);
}

float PictureIntegral::Mean(float x, float y, float width, float height) const {
  // A sliver at least, so that a place beyond the border or a point has a mean.
  const double sliver_px = 1e-3;
  const double side = side_px_;
  const auto bounds = [side, sliver_px](double center, double length) {
    const double half = 0.5 * std::max(length * side, sliver_px);
    const double middle = std::clamp(center * side, 0.0, side);
    return std::pair(std::clamp(std::min(middle - half, side - sliver_px), 0.0, side),
                     std::clamp(std::max(middle + half, sliver_px), 0.0, side));
  };
  const auto [left, right] = bounds(x, width);
  const auto [top, bottom] = bounds(y, height);
  const double sum = IntegralTo(right, bottom) - IntegralTo(left, bottom) - IntegralTo(right, top) +
                     IntegralTo(left, top);
  return static_cast<float>(sum / ((right - left) * (bottom - top)));
}

}  // namespace plumb::internal
