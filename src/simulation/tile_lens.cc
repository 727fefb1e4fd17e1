// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/tile_lens.h"

#include <Eigen/LU>
#include <algorithm>

#include "plumbline/common/check.h"

namespace plumb::internal {
namespace {

// Nodes of the interpolation on [-1, 1]: the tile's borders and thirds.
const Eigen::Vector4d kNodes(-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0);

Eigen::Vector4d Powers(double s) { return {1.0, s, s * s, s * s * s}; }
Eigen::Vector4d PowerDerivatives(double s) { return {0.0, 1.0, 2.0 * s, 3.0 * s * s}; }

Eigen::Matrix4d InverseVandermonde() {
  Eigen::Matrix4d powers;
  for (int i = 0; i < 4; ++i) powers.row(i) = Powers(kNodes[i]).transpose();
  return powers.inverse();
}

Eigen::Vector2d ExactRay(const Camera& camera, double column, double row) {
  const std::optional<Eigen::Vector2d> ray = camera.Unproject({column, row});
  PLUMB_CHECK(ray.has_value());  // A camera's field covers its image.
  return *ray;
}

// A cubic of the column and the derivative of another by the row, for one row of pixels.
struct RowPolynomial {
  std::array<float, 4> value;
  std::array<float, 4> by_row;

  RowPolynomial(const Eigen::Matrix4d& coefficients, double t, double half_height) {
    const Eigen::Vector4d values = coefficients * Powers(t);
    const Eigen::Vector4d derivatives = coefficients * PowerDerivatives(t) / half_height;
    for (int i = 0; i < 4; ++i) {
      value[i] = static_cast<float>(values[i]);
      by_row[i] = static_cast<float>(derivatives[i]);
    }
  }
  // The constant comes last: all else is small, so that only one rounding counts.
  float Value(float s) const { return value[0] + s * (value[1] + s * (value[2] + s * value[3])); }
  float ByRow(float s) const {
    return by_row[0] + s * (by_row[1] + s * (by_row[2] + s * by_row[3]));
  }
  float ByColumn(float s) const { return value[1] + s * (2.0F * value[2] + s * 3.0F * value[3]); }
};

}  // namespace

TileLens::TileLens(const Camera& camera, int left, int top, int width, int height)
    : camera_(camera),
      center_column_(left + 0.5 * (width - 1)),
      center_row_(top + 0.5 * (height - 1)),
      half_width_(0.5 * width),
      half_height_(0.5 * height) {
  Eigen::Matrix4d x;
  Eigen::Matrix4d y;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const Eigen::Vector2d ray = ExactRay(
          camera, center_column_ + kNodes[i] * half_width_, center_row_ + kNodes[j] * half_height_);
      x(i, j) = ray.x();
      y(i, j) = ray.y();
    }
  }
  static const Eigen::Matrix4d kInverse = InverseVandermonde();
  x_ = kInverse * x * kInverse.transpose();
  y_ = kInverse * y * kInverse.transpose();
  is_interpolated_ = MaxErrorPx() <= kMaxLensErrorPx;
}

Eigen::Vector2d TileLens::Interpolate(double column, double row) const {
  const Eigen::Vector4d s = Powers((column - center_column_) / half_width_);
  const Eigen::Vector4d t = Powers((row - center_row_) / half_height_);
  return {s.dot(x_ * t), s.dot(y_ * t)};
}

// At the centres of the nine cells between the nodes, where an interpolation is worst.
double TileLens::MaxErrorPx() const {
  const double focal_px = std::max(camera_.lens()[kFx], camera_.lens()[kFy]);
  double max_error = 0.0;
  for (const double s : {-0.8, 0.0, 0.8}) {
    for (const double t : {-0.8, 0.0, 0.8}) {
      const double column = center_column_ + s * half_width_;
      const double row = center_row_ + t * half_height_;
      const Eigen::Vector2d error = Interpolate(column, row) - ExactRay(camera_, column, row);
      max_error = std::max(max_error, focal_px * error.norm());
    }
  }
  return max_error;
}

void TileLens::Row(int first_column, int row, int count, PixelRay* rays) const {
  const double t = (row - center_row_) / half_height_;
  const RowPolynomial x(x_, t, half_height_);
  const RowPolynomial y(y_, t, half_height_);
  const auto per_column = static_cast<float>(1.0 / half_width_);
  for (int i = 0; i < count; ++i) {
    const float s = static_cast<float>(first_column + i - center_column_) * per_column;
    rays[i] = {x.Value(s),
               y.Value(s),
               x.ByColumn(s) * per_column,
               x.ByRow(s),
               y.ByColumn(s) * per_column,
               y.ByRow(s)};
  }
  if (is_interpolated_) return;
  for (int i = 0; i < count; ++i) {
    const auto ray = camera_.Unproject(Eigen::Vector2d(first_column + i, row));
    if (!ray) continue;  // Outside the image: the neighbour only asks what it meets.
    rays[i].x = static_cast<float>(ray->x());
    rays[i].y = static_cast<float>(ray->y());
  }
}

}  // namespace plumb::internal
