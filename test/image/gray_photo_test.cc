// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/gray_photo.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace plumb {
namespace {

cv::Mat Ramp() {
  cv::Mat ramp(37, 53, CV_8U);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(4 * x + y);
    }
  }
  return ramp;
}

TEST(DecodeGrayPhoto, GivesThePixelsOfPngAndJpeg) {
  for (const char* ending : {".png", ".jpg"}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(ending, Ramp(), bytes);
    const GrayPhoto photo = DecodeGrayPhoto(bytes);
    ASSERT_EQ(photo.problem, "");
    ASSERT_EQ(photo.gray.size(), Ramp().size());
    EXPECT_LT(cv::norm(photo.gray, Ramp(), cv::NORM_INF), 4.0);  // JPEG's own loss.
  }
}

TEST(DecodeGrayPhoto, SaysWhatIsWrongWithTheBytes) {
  EXPECT_NE(DecodeGrayPhoto({}).problem, "");
  EXPECT_NE(DecodeGrayPhoto({1, 2, 3}).problem, "");
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", Ramp(), bytes);
  bytes.resize(bytes.size() / 2);
  const GrayPhoto photo = DecodeGrayPhoto(bytes);
  EXPECT_NE(photo.problem, "");
  EXPECT_TRUE(photo.gray.empty());
}

}  // namespace
}  // namespace plumb
