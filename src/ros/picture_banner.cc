// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/picture_banner.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plumb::ros_adapter {
namespace {

// Sizes are for a picture of this width and grow with it.
constexpr double kReferenceWidth_px = 1280.0;

// The title shrinks until a long file name fits.
double FittingSize(const BannerLine& line, double unit, int width_px, int thickness) {
  const double size = line.size * unit;
  const cv::Size extent =
      cv::getTextSize(line.text, cv::FONT_HERSHEY_SIMPLEX, size, thickness, nullptr);
  return extent.width <= width_px ? size : size * width_px / extent.width;
}

}  // namespace

cv::Mat DrawBanner(const std::vector<BannerLine>& lines, int width_px) {
  const double unit = width_px / kReferenceWidth_px;
  const int margin_px = static_cast<int>(std::lround(14.0 * unit));
  double height_px = 2.0 * margin_px;
  for (const BannerLine& line : lines) height_px += 36.0 * line.size * unit;
  cv::Mat banner(static_cast<int>(std::lround(height_px)), width_px, CV_8UC3, kBlack);
  double y_px = margin_px;
  for (const BannerLine& line : lines) {
    const int thickness = std::max(1, static_cast<int>(std::lround(2.0 * line.size * unit)));
    const double size = FittingSize(line, unit, width_px - 3 * margin_px, thickness);
    y_px += 36.0 * line.size * unit;
    const cv::Point origin(2 * margin_px, static_cast<int>(std::lround(y_px - 8.0 * unit)));
    cv::putText(banner,
                line.text,
                origin,
                cv::FONT_HERSHEY_SIMPLEX,
                size,
                line.color,
                thickness,
                cv::LINE_AA);
  }
  banner.colRange(0, margin_px).setTo(lines.front().color);
  return banner;
}

std::vector<std::string> WrapText(const std::string& text, std::size_t max_length) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    std::size_t end = std::min(text.size(), begin + max_length);
    if (end < text.size()) {
      const std::size_t blank = text.rfind(' ', end);
      if (blank != std::string::npos && blank > begin) end = blank;
    }
    lines.push_back(text.substr(begin, end - begin));
    begin = end < text.size() && text[end] == ' ' ? end + 1 : end;
  }
  return lines;
}

}  // namespace plumb::ros_adapter
