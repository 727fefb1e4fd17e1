// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/outline_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "test/support/random.h"

namespace plumb::test {
namespace {

TEST(MomentsOf, AreThoseOfOpenCvInEitherSense) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    cv::Mat mask = cv::Mat::zeros(200, 4000, CV_8U);
    cv::ellipse(mask,
                {3900 + random.Index(20), 100 + random.Index(20)},
                {3 + random.Index(40), 3 + random.Index(40)},
                random.Uniform(0.0, 180.0),
                0.0,
                360.0,
                cv::Scalar(255),
                cv::FILLED);
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(mask, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    ASSERT_EQ(outlines.size(), 1u);
    const cv::Moments expected = cv::moments(outlines[0]);
    for (int sense = 0; sense < 2; ++sense) {
      const OutlineMoments moments = MomentsOf(outlines[0]);
      EXPECT_EQ(moments.area_px2, expected.m00);
      EXPECT_NEAR(moments.centroid_px.x(), expected.m10 / expected.m00, 1e-9);
      EXPECT_NEAR(moments.centroid_px.y(), expected.m01 / expected.m00, 1e-9);
      // OpenCV's are differences of numbers of 1e7, in doubles.
      EXPECT_NEAR(moments.spread_px2(0, 0), expected.mu20 / expected.m00, 1e-6);
      EXPECT_NEAR(moments.spread_px2(0, 1), expected.mu11 / expected.m00, 1e-6);
      EXPECT_NEAR(moments.spread_px2(1, 0), expected.mu11 / expected.m00, 1e-6);
      EXPECT_NEAR(moments.spread_px2(1, 1), expected.mu02 / expected.m00, 1e-6);
      std::reverse(outlines[0].begin(), outlines[0].end());
    }
  }
}

TEST(MomentsOf, ALineHasNoArea) {
  EXPECT_EQ(MomentsOf({}).area_px2, 0.0);
  EXPECT_EQ(MomentsOf({{7, 5}}).area_px2, 0.0);
  EXPECT_EQ(MomentsOf({{7, 5}, {8, 6}, {9, 7}, {8, 6}}).area_px2, 0.0);
}

}  // namespace
}  // namespace plumb::test
