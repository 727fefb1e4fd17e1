// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/code_reader.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "test/support/marker_scene.h"

namespace plumb::test {
namespace {

constexpr int kId = 11;
constexpr double kRadiusPx = 60.0;
constexpr int kSidePx = 241;

// A marker amid a white picture.
cv::Mat Picture() {
  const Face face = MarkerFace(kId);
  cv::Mat picture(kSidePx, kSidePx, CV_8U, cv::Scalar(255));
  for (int y = 0; y < kSidePx; ++y) {
    for (int x = 0; x < kSidePx; ++x) {
      const Eigen::Vector2d point = (Eigen::Vector2d(x, y).array() - kSidePx / 2) / kRadiusPx;
      if (point.norm() < kQuietRadius && !face(point)) picture.at<std::uint8_t>(y, x) = 0;
    }
  }
  cv::GaussianBlur(picture, picture, {5, 5}, 0.9);
  return picture;
}

Eigen::Matrix3d PixelFromCircle(const Eigen::Vector2d& center_px) {
  Eigen::Matrix3d pixel_from_circle = Eigen::Matrix3d::Identity();
  pixel_from_circle.topLeftCorner<2, 2>() *= kRadiusPx;
  pixel_from_circle.topRightCorner<2, 1>() = center_px;
  return pixel_from_circle;
}

// What lies beyond the photo is in the same memory here and would read well.
TEST(ReadCode, DoesNotReadBeyondThePhoto) {
  const cv::Mat picture = Picture();
  constexpr int kMiddle = kSidePx / 2;
  constexpr int kCut = kMiddle - 64;  // The black circle is left whole, the white about it is not.
  const Eigen::Vector2d middle(kMiddle, kMiddle);
  const auto read = [&](const cv::Rect& part) {
    const Eigen::Vector2d center = middle - Eigen::Vector2d(part.x, part.y);
    const cv::Mat photo = picture(part);
    return ReadCode({}, GraySampler(photo), PixelFromCircle(center), {});
  };
  const std::optional<CodeReading> whole = read({0, 0, kSidePx, kSidePx});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->id, kId);
  EXPECT_FALSE(read({kCut, 0, kSidePx - kCut, kSidePx}));
  EXPECT_FALSE(read({0, kCut, kSidePx, kSidePx - kCut}));
  EXPECT_FALSE(read({0, 0, kSidePx - kCut, kSidePx}));
  EXPECT_FALSE(read({0, 0, kSidePx, kSidePx - kCut}));
}

}  // namespace
}  // namespace plumb::test
