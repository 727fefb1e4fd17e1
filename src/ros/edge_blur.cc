// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/edge_blur.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumb::ros_adapter {
namespace {

// Below, the black ring is slimmer than 2 px.
constexpr double kMinSemiMinor_px = 10.0;
constexpr int kNumDirections = 32;
constexpr double kStep_px = 0.5;

// From the middle of the black ring to near the end of the quiet zone [outer radii].
constexpr double kInnerRadius = 0.9;
constexpr double kOuterRadius = 1.2;

// Of the blur over the directions: a motion flattens the edge on two sides only.
constexpr double kDirectionQuantile = 0.85;

double Quantile(std::vector<double> values, double fraction) {
  const auto place = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

// Bilinear; nothing outside the image.
std::optional<double> GrayAt(const cv::Mat& gray, const Eigen::Vector2d& pixel) {
  const double x0 = std::floor(pixel.x());
  const double y0 = std::floor(pixel.y());
  if (!(x0 >= 0.0 && y0 >= 0.0 && x0 + 1.0 < gray.cols && y0 + 1.0 < gray.rows)) {
    return std::nullopt;
  }
  const int x = static_cast<int>(x0);
  const int y = static_cast<int>(y0);
  const double right = pixel.x() - x0;
  const double below = pixel.y() - y0;
  const auto at = [&gray](int row, int col) {
    return static_cast<double>(gray.at<std::uint8_t>(row, col));
  };
  return (1.0 - below) * ((1.0 - right) * at(y, x) + right * at(y, x + 1)) +
         below * ((1.0 - right) * at(y + 1, x) + right * at(y + 1, x + 1));
}

// Grey values across the outer edge, from the inside to the outside, a step apart along the edge's
// normal; empty if the image ends before.
std::vector<double> ProfileAcross(const cv::Mat& gray, const Ellipse& ellipse, double angle_rad) {
  const Eigen::Matrix2d pixel_from_circle = ellipse.PixelFromCircle();
  const Eigen::Vector2d on_circle(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d spoke = pixel_from_circle * on_circle;
  const Eigen::Vector2d normal = (pixel_from_circle.inverse() * on_circle).normalized();
  const double radius_px = spoke.dot(normal);  // From the centre to the tangent.
  const Eigen::Vector2d edge = ellipse.center_px + spoke;
  std::vector<double> profile;
  for (double at_px = (kInnerRadius - 1.0) * radius_px; at_px <= (kOuterRadius - 1.0) * radius_px;
       at_px += kStep_px) {
    const auto value = GrayAt(gray, edge + at_px * normal);
    if (!value) return {};
    profile.push_back(*value);
  }
  return profile;
}

// A Gaussian blur of sigma makes a step of height h as steep as h / (sqrt(2 pi) sigma).
std::optional<double> BlurOfMarker(const cv::Mat& gray, const Ellipse& ellipse) {
  std::vector<double> values;
  std::vector<double> slopes;  // Grey levels a pixel.
  for (int i = 0; i < kNumDirections; ++i) {
    const std::vector<double> profile =
        ProfileAcross(gray, ellipse, 2.0 * M_PI * i / kNumDirections);
    double steepest = 0.0;
    for (std::size_t k = 2; k < profile.size(); ++k) {
      steepest = std::max(steepest, (profile[k] - profile[k - 2]) / (2.0 * kStep_px));
    }
    if (profile.size() < 3) continue;
    values.insert(values.end(), profile.begin(), profile.end());
    slopes.push_back(steepest);
  }
  if (slopes.size() < kNumDirections / 2) return std::nullopt;
  const double height = Quantile(values, 0.95) - Quantile(values, 0.05);
  const double slope = Quantile(slopes, 1.0 - kDirectionQuantile);
  if (!(height > 0.0 && slope > 0.0)) return std::nullopt;
  return height / (std::sqrt(2.0 * M_PI) * slope);
}

}  // namespace

std::optional<double> EdgeBlur_px(const cv::Mat& gray,
                                  const std::vector<MarkerDetection>& markers) {
  std::vector<double> blurs;
  for (const MarkerDetection& marker : markers) {
    if (marker.ellipse.semi_minor_px < kMinSemiMinor_px) continue;
    if (const auto blur = BlurOfMarker(gray, marker.ellipse)) blurs.push_back(*blur);
  }
  if (blurs.empty()) return std::nullopt;
  return Quantile(blurs, 0.5);
}

}  // namespace plumb::ros_adapter
