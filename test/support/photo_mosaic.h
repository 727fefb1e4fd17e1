// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace plumb::test {

// A photo enlarged to a size with its own mirror images: as sharp as itself, and with shapes that
// are as symmetric as markers are.
inline cv::Mat Mosaic(const cv::Mat& gray, const cv::Size& size) {
  cv::Mat mosaic;
  cv::copyMakeBorder(gray,
                     mosaic,
                     0,
                     std::max(0, size.height - gray.rows),
                     0,
                     std::max(0, size.width - gray.cols),
                     cv::BORDER_REFLECT);
  return mosaic(cv::Rect(0, 0, size.width, size.height));
}

}  // namespace plumb::test
