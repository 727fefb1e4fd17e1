// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/annotated_photo.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "plumbline/map/verdict_wording.h"
#include "ros/picture_banner.h"

namespace plumb::ros_adapter {
namespace {

const cv::Scalar& ColorOf(VerdictStatus status) {
  switch (status) {
    case VerdictStatus::kAccepted:
      return kGreen;
    case VerdictStatus::kWaiting:
      return kYellow;
    case VerdictStatus::kRefused:
      return kRed;
  }
  return kRed;
}

cv::Mat DecodeReduced(const std::vector<std::uint8_t>& bytes, cv::Size full, cv::Size reduced) {
  int flag = cv::IMREAD_COLOR;
  if (full.width >= 4 * reduced.width) {
    flag = cv::IMREAD_REDUCED_COLOR_4;
  } else if (full.width >= 2 * reduced.width) {
    flag = cv::IMREAD_REDUCED_COLOR_2;
  }
  cv::Mat photo;
  try {
    if (!bytes.empty()) photo = cv::imdecode(bytes, flag | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    photo.release();  // The verdict tells that it is undecodable.
  }
  if (photo.empty()) return cv::Mat(reduced, CV_8UC3, cv::Scalar(90, 90, 90));
  cv::Mat resized;
  cv::resize(photo, resized, reduced, 0.0, 0.0, cv::INTER_AREA);
  return resized;
}

// Pixel centres are at whole numbers in both pictures.
void DrawPoints(const std::vector<Eigen::Vector2f>& pixels,
                double scale,
                const cv::Scalar& color,
                cv::Mat* picture) {
  const int radius = std::max(2, static_cast<int>(std::lround(picture->cols / 400.0)));
  for (const Eigen::Vector2f& pixel : pixels) {
    const cv::Point center(static_cast<int>(std::lround((pixel.x() + 0.5) * scale - 0.5)),
                           static_cast<int>(std::lround((pixel.y() + 0.5) * scale - 0.5)));
    cv::circle(*picture, center, radius + 1, kBlack, cv::FILLED, cv::LINE_AA);
    cv::circle(*picture, center, radius, color, cv::FILLED, cv::LINE_AA);
  }
}

std::string Spaced(std::string word) {
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

std::string Upper(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) {
    return static_cast<char>(std::toupper(c));
  });
  return word;
}

std::vector<BannerLine> BannerLines(const PhotoVerdict& verdict, const PhotoCounts& counts) {
  std::string title = Upper(ToString(verdict.status)) + "  " + verdict.name;
  if (verdict.reason != RefusalReason::kNone) title += ": " + Spaced(ToString(verdict.reason));
  std::vector<BannerLine> lines = {{title, 2.6, ColorOf(verdict.status)}};
  const auto add = [&](const std::string& text) {
    for (const std::string& line : WrapText(text, 36)) lines.push_back({line, 2.0, kWhite});
  };
  add(verdict.hint);
  add(DescribeAgreement(verdict));
  add(std::to_string(counts.num_accepted) + " accepted, " + std::to_string(counts.num_waiting) +
      " waiting, " + std::to_string(counts.num_refused) + " refused");
  return lines;
}

}  // namespace

cv::Mat DrawAnnotatedPhoto(const std::vector<std::uint8_t>& bytes,
                           const PhotoVerdict& verdict,
                           const PhotoCounts& counts,
                           int full_width_px,
                           int full_height_px,
                           int max_width_px) {
  const double scale = std::min(1.0, static_cast<double>(max_width_px) / full_width_px);
  const cv::Size full(full_width_px, full_height_px);
  const cv::Size reduced(std::max(1, static_cast<int>(std::lround(full_width_px * scale))),
                         std::max(1, static_cast<int>(std::lround(full_height_px * scale))));
  cv::Mat photo = DecodeReduced(bytes, full, reduced);
  DrawPoints(verdict.outlier_pixels, scale, kRed, &photo);
  DrawPoints(verdict.inlier_pixels, scale, kGreen, &photo);
  cv::Mat picture;
  cv::vconcat(DrawBanner(BannerLines(verdict, counts), photo.cols), photo, picture);
  return picture;
}

}  // namespace plumb::ros_adapter
