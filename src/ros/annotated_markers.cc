// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/annotated_markers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "ros/picture_banner.h"

namespace plumb::ros_adapter {
namespace {

constexpr int kNumOutlinePoints = 48;
constexpr int kShift = 4;                   // Of OpenCV's fixed-point pixels.
constexpr std::size_t kMaxLineLength = 80;  // Letters of a banner's line.
constexpr std::size_t kMaxIdLines = 2;      // More would hide the photo.
const cv::Size kSizeOfNoPhoto(1280, 960);

std::map<int, int> CountById(const std::vector<MarkerDetection>& detections) {
  std::map<int, int> counts;
  for (const MarkerDetection& detection : detections) ++counts[detection.id];
  return counts;
}

// Pixel centres are at whole numbers in both pictures.
cv::Point2d Reduce(const Eigen::Vector2d& pixel, double scale) {
  return {(pixel.x() + 0.5) * scale - 0.5, (pixel.y() + 0.5) * scale - 0.5};
}

cv::Point Fixed(const cv::Point2d& point) {
  constexpr double kOne = 1 << kShift;
  return {static_cast<int>(std::lround(point.x * kOne)),
          static_cast<int>(std::lround(point.y * kOne))};
}

void DrawOutline(const Ellipse& ellipse, double scale, const cv::Scalar& color, cv::Mat* picture) {
  const Eigen::Matrix2d pixel_from_circle = ellipse.PixelFromCircle();
  std::vector<cv::Point> outline;
  for (int i = 0; i < kNumOutlinePoints; ++i) {
    const double angle_rad = 2.0 * M_PI * i / kNumOutlinePoints;
    const Eigen::Vector2d on_circle(std::cos(angle_rad), std::sin(angle_rad));
    outline.push_back(Fixed(Reduce(ellipse.center_px + pixel_from_circle * on_circle, scale)));
  }
  cv::polylines(*picture, outline, /*isClosed=*/true, color, 2, cv::LINE_AA, kShift);
}

void DrawMarker(const MarkerDetection& marker,
                double scale,
                const cv::Scalar& color,
                cv::Mat* picture) {
  DrawOutline(marker.ellipse, scale, color, picture);
  const cv::Point2d center = Reduce(marker.center_px, scale);
  constexpr double kArm_px = 4.0;
  for (const cv::Point2d arm : {cv::Point2d(kArm_px, 0.0), cv::Point2d(0.0, kArm_px)}) {
    cv::line(*picture, Fixed(center - arm), Fixed(center + arm), kRed, 1, cv::LINE_AA, kShift);
  }
  const double size = std::max(0.6, picture->cols / 1600.0);
  const double beside_px = marker.ellipse.semi_major_px * scale + 4.0;
  const cv::Point origin(center + cv::Point2d(beside_px, 8.0 * size));
  const std::string id = std::to_string(marker.id);
  for (const auto& [ink, thickness] : {std::pair(kBlack, 5), std::pair(color, 2)}) {
    cv::putText(*picture, id, origin, cv::FONT_HERSHEY_SIMPLEX, size, ink, thickness, cv::LINE_AA);
  }
}

// "IDs 3, 9 (twice), 20", in few lines.
std::vector<std::string> IdLines(const std::map<int, int>& counts) {
  std::string text;
  for (const auto& [id, count] : counts) {
    text += (text.empty() ? "IDs " : ", ") + std::to_string(id);
    if (count == 2) text += " (twice)";
    if (count > 2) text += " (" + std::to_string(count) + " times)";
  }
  std::vector<std::string> lines = WrapText(text, kMaxLineLength);
  if (lines.size() > kMaxIdLines) {
    lines.resize(kMaxIdLines);
    lines.back() += " ...";
  }
  return lines;
}

std::vector<BannerLine> BannerLines(const MarkerSearch& search,
                                    const std::map<int, int>& counts,
                                    const std::string& name) {
  if (!search.problem.empty()) {
    std::vector<BannerLine> lines = {{"NOT SEARCHED  " + name, 1.2, kRed}};
    for (const std::string& line : WrapText(search.problem, kMaxLineLength)) {
      lines.push_back({line, 0.9, kWhite});
    }
    return lines;
  }
  const std::size_t num_markers = search.detections.size();
  const std::string title =
      std::to_string(num_markers) + (num_markers == 1 ? " marker" : " markers");
  const cv::Scalar& color =
      num_markers == 0 ? kWhite : (counts.size() < num_markers ? kYellow : kGreen);
  std::vector<BannerLine> lines = {{title + "  " + name, 1.2, color}};
  for (const std::string& line : IdLines(counts)) lines.push_back({line, 0.9, kWhite});
  return lines;
}

}  // namespace

cv::Mat DrawAnnotatedMarkers(const MarkerSearch& search,
                             const std::string& name,
                             int max_width_px) {
  const bool has_photo = !search.gray.empty();
  const cv::Size full = has_photo ? search.gray.size() : kSizeOfNoPhoto;
  const double scale = std::min(1.0, static_cast<double>(max_width_px) / full.width);
  const cv::Size reduced(std::max(1, static_cast<int>(std::lround(full.width * scale))),
                         std::max(1, static_cast<int>(std::lround(full.height * scale))));
  cv::Mat photo(reduced, CV_8UC3, cv::Scalar(90, 90, 90));
  if (has_photo) {
    cv::Mat gray;
    cv::resize(search.gray, gray, reduced, 0.0, 0.0, cv::INTER_AREA);
    cv::cvtColor(gray, photo, cv::COLOR_GRAY2BGR);
  }
  const std::map<int, int> counts = CountById(search.detections);
  for (const MarkerDetection& marker : search.detections) {
    DrawMarker(marker, scale, counts.at(marker.id) > 1 ? kYellow : kGreen, &photo);
  }
  cv::Mat picture;
  cv::vconcat(DrawBanner(BannerLines(search, counts, name), photo.cols), photo, picture);
  return picture;
}

}  // namespace plumb::ros_adapter
