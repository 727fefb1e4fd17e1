// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

namespace plumb {

// A grey image of floats in [0, 255], row by row. Rows are padded to a multiple of
// kRowAlignment so that vector code may run over their end; the padding holds finite values.
class FloatImage {
 public:
  static constexpr int kRowAlignment = 32;

  FloatImage() = default;
  // Rows are not initialised; the padding is once FillPadding was called.
  FloatImage(int width, int height)
      : width_(width),
        height_(height),
        stride_((width + kRowAlignment - 1) / kRowAlignment * kRowAlignment),
        values_(new float[static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height)]) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int stride() const { return stride_; }
  bool empty() const { return values_ == nullptr; }

  float* Row(int y) { return values_.get() + static_cast<std::ptrdiff_t>(y) * stride_; }
  const float* Row(int y) const { return values_.get() + static_cast<std::ptrdiff_t>(y) * stride_; }
  float At(int x, int y) const { return Row(y)[x]; }

  // Repeats the last pixel of row `y` into its padding.
  void FillPadding(int y) { std::fill(Row(y) + width_, Row(y) + stride_, Row(y)[width_ - 1]); }

 private:
  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  std::unique_ptr<float[]> values_;
};

}  // namespace plumb
