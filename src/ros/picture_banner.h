// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace plumb::ros_adapter {

// Colours that annotated pictures share; BGR.
inline const cv::Scalar kGreen(60, 220, 60);
inline const cv::Scalar kRed(60, 60, 255);
inline const cv::Scalar kYellow(0, 200, 255);
inline const cv::Scalar kWhite(255, 255, 255);
inline const cv::Scalar kBlack(0, 0, 0);

struct BannerLine {
  std::string text;
  double size;  // Of the letters; 1 is 22 px high in a picture of 1280 px.
  cv::Scalar color;
};

// Letters on black, with a bar in the first line's colour. A line that is too long shrinks. 8-bit
// BGR. There must be a line.
cv::Mat DrawBanner(const std::vector<BannerLine>& lines, int width_px);

// `text` in lines of at most `max_length` characters, broken at blanks where there are any.
std::vector<std::string> WrapText(const std::string& text, std::size_t max_length);

}  // namespace plumb::ros_adapter
