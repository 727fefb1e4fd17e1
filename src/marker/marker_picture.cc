// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

constexpr int kMinSidePx = 8;
constexpr int kMaxSidePx = 8192;
constexpr int kSamplesPerAxis = 8;

// From the nearest circle or border of two cells, in outer radii.
double DistanceToEdge(const Eigen::Vector2d& point_in_marker) {
  const double radius = point_in_marker.norm();
  double distance = std::abs(radius - 1.0);
  for (const double edge : {kDiscRadius, kStripeInnerRadius, kStripeOuterRadius}) {
    distance = std::min(distance, std::abs(radius - edge));
  }
  if (radius <= kStripeInnerRadius || radius >= kStripeOuterRadius) return distance;
  const double cells =
      std::atan2(point_in_marker.y(), point_in_marker.x()) / (2.0 * M_PI) * kNumCodeBits;
  const double off_border_rad = (cells - std::round(cells)) * 2.0 * M_PI / kNumCodeBits;
  return std::min(distance, radius * std::abs(std::sin(off_border_rad)));
}

std::uint8_t MeanGray(std::uint32_t word, int x, int y, int side_px) {
  const Eigen::Vector2d center_in_marker =
      (Eigen::Vector2d(x + 0.5, y + 0.5) / side_px - Eigen::Vector2d::Constant(0.5)) * 2.0 *
      kSidePerDiameter;
  const double half_diagonal = std::sqrt(2.0) * kSidePerDiameter / side_px;
  if (DistanceToEdge(center_in_marker) > half_diagonal) {
    return IsWhite(word, center_in_marker) ? 255 : 0;
  }
  int num_white = 0;
  for (int i = 0; i < kSamplesPerAxis; ++i) {
    for (int j = 0; j < kSamplesPerAxis; ++j) {
      const Eigen::Vector2d in_picture(x + (j + 0.5) / kSamplesPerAxis,
                                       y + (i + 0.5) / kSamplesPerAxis);
      const Eigen::Vector2d in_marker =
          (in_picture / side_px - Eigen::Vector2d::Constant(0.5)) * 2.0 * kSidePerDiameter;
      if (IsWhite(word, in_marker)) ++num_white;
    }
  }
  return static_cast<std::uint8_t>(
      std::lround(255.0 * num_white / (kSamplesPerAxis * kSamplesPerAxis)));
}

}  // namespace

bool IsWhite(std::uint32_t word, const Eigen::Vector2d& point_in_marker) {
  const double radius = point_in_marker.norm();
  if (radius >= 1.0 || radius < kDiscRadius) return true;
  if (radius >= kStripeOuterRadius || radius < kStripeInnerRadius) return false;
  const double turns = std::atan2(point_in_marker.y(), point_in_marker.x()) / (2.0 * M_PI);
  const int cell = static_cast<int>((turns < 0.0 ? turns + 1.0 : turns) * kNumCodeBits);
  return ((word >> (cell % kNumCodeBits)) & 1) != 0;
}

std::vector<std::uint8_t> MarkerPicture(int id, int side_px) {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  if (id < 0 || id >= codebook.size()) {
    throw std::invalid_argument("there is no marker " + std::to_string(id) + ": IDs are 0 to " +
                                std::to_string(codebook.size() - 1));
  }
  if (side_px < kMinSidePx || side_px > kMaxSidePx) {
    throw std::invalid_argument("the side of a marker's picture must be 8 to 8192 pixels, but is " +
                                std::to_string(side_px));
  }
  const std::uint32_t word = codebook.Word(id);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px));
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) pixels.push_back(MeanGray(word, x, y, side_px));
  }
  return pixels;
}

}  // namespace plumb
