// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/outlines.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

namespace plumb::test {
namespace {

using Outline = std::vector<std::pair<int, int>>;

Outline ToPairs(const std::vector<cv::Point>& points) {
  Outline outline;
  for (const cv::Point& point : points) outline.emplace_back(point.x, point.y);
  return outline;
}

std::vector<Outline> Visited(const cv::Mat& mask) {
  cv::Mat scratch = mask.clone();
  std::vector<Outline> outlines;
  VisitOutlines(scratch,
                [&](const std::vector<cv::Point>& points) { outlines.push_back(ToPairs(points)); });
  return outlines;
}

std::vector<Outline> FoundByOpenCv(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> found;
  cv::findContours(mask, found, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  std::vector<Outline> outlines;
  for (const std::vector<cv::Point>& points : found) outlines.push_back(ToPairs(points));
  return outlines;
}

// Noise with structures as large as `blur_px`; the rim is 0.
cv::Mat RandomMask(int seed, double blur_px) {
  cv::Mat noise(97, 140, CV_32F);
  cv::RNG(static_cast<std::uint64_t>(seed)).fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  if (blur_px > 0.0) cv::GaussianBlur(noise, noise, {}, blur_px);
  cv::Mat mask = noise > 0.0;
  cv::rectangle(mask, {0, 0, mask.cols, mask.rows}, cv::Scalar(0), 1);
  return mask;
}

TEST(VisitOutlines, FindsWhatOpenCvFinds) {
  for (const double blur_px : {0.0, 0.7, 1.5, 4.0}) {
    for (int seed = 1; seed <= 10; ++seed) {
      const cv::Mat mask = RandomMask(seed, blur_px);
      EXPECT_THAT(Visited(mask), testing::UnorderedElementsAreArray(FoundByOpenCv(mask)));
    }
  }
}

TEST(VisitOutlines, TakesPartOfALargerMaskAndAnyValueButZero) {
  const cv::Mat mask = RandomMask(1, 1.5);
  cv::Mat larger(mask.rows + 4, mask.cols + 7, CV_8U, cv::Scalar(255));
  cv::Mat part = larger(cv::Rect(3, 2, mask.cols, mask.rows));
  mask.copyTo(part);
  part.setTo(5, mask);
  std::vector<Outline> outlines;
  VisitOutlines(part,
                [&](const std::vector<cv::Point>& points) { outlines.push_back(ToPairs(points)); });
  EXPECT_EQ(outlines, Visited(mask));
  part.setTo(255);
  EXPECT_EQ(cv::countNonZero(larger != 255), 0);  // Nothing beside it was written.
}

TEST(VisitOutlines, ARingHasTwoAndAPointHasOne) {
  cv::Mat mask = cv::Mat::zeros(40, 40, CV_8U);
  cv::circle(mask, {20, 20}, 12, cv::Scalar(255), 3);
  mask.at<std::uint8_t>(2, 3) = 1;
  const std::vector<Outline> outlines = Visited(mask);
  ASSERT_EQ(outlines.size(), 3u);
  EXPECT_EQ(outlines[0], (Outline{{3, 2}}));
}

TEST(VisitOutlines, TheRimCountsAsOutside) {
  EXPECT_EQ(Visited(cv::Mat(5, 6, CV_8U, cv::Scalar(255))), Visited([] {
              cv::Mat mask = cv::Mat::zeros(5, 6, CV_8U);
              mask(cv::Rect(1, 1, 4, 3)).setTo(7);
              return mask;
            }()));
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 2), cv::Size(0, 0)}) {
    EXPECT_TRUE(Visited(cv::Mat(size, CV_8U, cv::Scalar(255))).empty());
  }
}

}  // namespace
}  // namespace plumb::test
