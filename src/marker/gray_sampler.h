// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace plumb {

// Bilinear grey values between the pixels of a CV_8UC1 image.
class GraySampler {
 public:
  explicit GraySampler(const cv::Mat& gray) : gray_(gray) {}

  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < gray_.cols - 1 &&
           pixel.y() < gray_.rows - 1;
  }

  // Contains(pixel) must hold.
  double At(const Eigen::Vector2d& pixel) const {
    const int x = static_cast<int>(pixel.x());
    const int y = static_cast<int>(pixel.y());
    const double right = pixel.x() - x;
    const double below = pixel.y() - y;
    const std::uint8_t* upper = gray_.ptr<std::uint8_t>(y) + x;
    const std::uint8_t* lower = gray_.ptr<std::uint8_t>(y + 1) + x;
    return (1.0 - below) * (upper[0] + right * (upper[1] - upper[0])) +
           below * (lower[0] + right * (lower[1] - lower[0]));
  }

  // Grey values at start, start + step, and so on, as many as there is room for, all of which
  // Contains() must hold, times kRayUnit. In integers, for converting pixels to floating point
  // takes longer than the rest; so the places are cut to 1 / 2^kRayBits px.
  static constexpr int kRayBits = 11;  // A grey value takes 8 + 2 * 11 of an int's bits.
  static constexpr int kRayUnit = 1 << 2 * kRayBits;
  void SampleRay(const Eigen::Vector2d& start,
                 const Eigen::Vector2d& step,
                 std::vector<int>* values) const {
    std::int64_t x = Fixed(start.x());
    std::int64_t y = Fixed(start.y());
    const std::int64_t step_x = Fixed(step.x());
    const std::int64_t step_y = Fixed(step.y());
    const std::uint8_t* const first = gray_.data;
    const auto stride = static_cast<std::ptrdiff_t>(gray_.step);
    for (int& value : *values) {
      const std::uint8_t* const upper = first + (y >> kFixedBits) * stride + (x >> kFixedBits);
      const std::uint8_t* const lower = upper + stride;
      const int above = Lerp(upper[0], upper[1], RayFraction(x));
      const int below = Lerp(lower[0], lower[1], RayFraction(x));
      value = Lerp(above, below, RayFraction(y));
      x += step_x;
      y += step_y;
    }
  }

  // Whether the pixels around an image point within `radius_px` are all there.
  bool ContainsSquare(const Eigen::Vector2d& center, double radius_px) const {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius_px);
    return Contains(center - reach) && Contains(center + reach);
  }

  const cv::Mat& gray() const { return gray_; }

 private:
  static constexpr int kFixedBits = 32;

  static std::int64_t Fixed(double pixel) {
    return static_cast<std::int64_t>(pixel * static_cast<double>(std::int64_t{1} << kFixedBits));
  }
  static int RayFraction(std::int64_t fixed) {
    return static_cast<int>(fixed >> (kFixedBits - kRayBits) & ((1 << kRayBits) - 1));
  }
  // Times 2^kRayBits.
  static int Lerp(int from, int to, int fraction) {
    return (from << kRayBits) + fraction * (to - from);
  }

  const cv::Mat& gray_;
};

}  // namespace plumb
