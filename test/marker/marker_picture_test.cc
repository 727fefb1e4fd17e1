// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

constexpr int kSidePx = 400;

int GrayAt(const std::vector<std::uint8_t>& picture, double radius, double angle_rad) {
  const double radius_px = 0.5 * kSidePx / kSidePerDiameter * radius;
  const int x = static_cast<int>(std::floor(0.5 * kSidePx + radius_px * std::cos(angle_rad)));
  const int y = static_cast<int>(std::floor(0.5 * kSidePx + radius_px * std::sin(angle_rad)));
  return picture[static_cast<std::size_t>(y * kSidePx + x)];
}

TEST(MarkerPicture, ShowsTheCirclesAndTheCode) {
  const int id = 37;
  const std::vector<std::uint8_t> picture = MarkerPicture(id, kSidePx);
  ASSERT_EQ(picture.size(), static_cast<std::size_t>(kSidePx * kSidePx));
  for (int cell = 0; cell < kNumCodeBits; ++cell) {
    const double angle_rad = 2.0 * M_PI * (cell + 0.5) / kNumCodeBits;
    const bool is_white = ((MarkerCodebook::Get().Word(id) >> cell) & 1) != 0;
    EXPECT_EQ(GrayAt(picture, 0.6, angle_rad), is_white ? 255 : 0);
    EXPECT_EQ(GrayAt(picture, 1.1, angle_rad), 255);
    EXPECT_EQ(GrayAt(picture, 0.9, angle_rad), 0);
    EXPECT_EQ(GrayAt(picture, 0.3, angle_rad), 0);
    EXPECT_EQ(GrayAt(picture, 0.1, angle_rad), 255);
  }
}

TEST(MarkerPicture, IsAreaTrueAtAnySize) {  // Law: the mean does not depend on the resolution.
  const auto mean = [](int side_px) {
    double sum = 0.0;
    for (const std::uint8_t gray : MarkerPicture(5, side_px)) sum += gray;
    return sum / side_px / side_px;
  };
  EXPECT_NEAR(mean(24), mean(600), 1.0);  // [grey levels]; rounding down takes half a level.
}

TEST(MarkerPicture, RefusesUnknownIdsAndSizes) {
  EXPECT_THROW(MarkerPicture(-1, 100), std::invalid_argument);
  EXPECT_THROW(MarkerPicture(MarkerCodebook::Get().size(), 100), std::invalid_argument);
  EXPECT_THROW(MarkerPicture(0, 4), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
