// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

#include "plumbline/camera/camera.h"

namespace plumb::internal {

// Where a raw pixel looks: the ray (x, y, 1) in the camera frame, and its change by pixel.
struct PixelRay {
  float x, y;
  float x_by_column, x_by_row;  // [1/px]
  float y_by_column, y_by_row;
};

// The viewing rays of a rectangle of a photo. Interpolates Camera::Unproject by a bicubic
// polynomial, checked against it between the nodes; where that misses by more than
// kMaxLensErrorPx, each ray is unprojected.
class TileLens {
 public:
  static constexpr double kMaxLensErrorPx = 2e-4;

  // Columns [left, left + width) and rows [top, top + height), all inside the image.
  TileLens(const Camera& camera, int left, int top, int width, int height);

  // Writes `count` rays of consecutive pixels, which may lie one pixel outside the rectangle.
  void Row(int first_column, int row, int count, PixelRay* rays) const;

  bool is_interpolated() const { return is_interpolated_; }

 private:
  using Coefficients = Eigen::Matrix4d;  // value = sum of (i, j) s^i t^j.

  Eigen::Vector2d Interpolate(double column, double row) const;
  double MaxErrorPx() const;

  const Camera& camera_;
  double center_column_, center_row_;
  double half_width_, half_height_;
  Coefficients x_, y_;
  bool is_interpolated_;
};

}  // namespace plumb::internal
