// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

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

  // Whether the pixels around an image point within `radius_px` are all there.
  bool ContainsSquare(const Eigen::Vector2d& center, double radius_px) const {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius_px);
    return Contains(center - reach) && Contains(center + reach);
  }

  const cv::Mat& gray() const { return gray_; }

 private:
  const cv::Mat& gray_;
};

}  // namespace plumb
