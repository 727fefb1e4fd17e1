// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/gray_sampler.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "test/support/random.h"

namespace plumb::test {
namespace {

TEST(GraySampler, ARayHasTheValuesOfItsPoints) {
  Random random(5);
  cv::Mat larger(60, 90, CV_8U);
  cv::randu(larger, 0, 256);
  larger(cv::Rect(20, 20, 9, 9)).setTo(255);  // The greatest value does not overflow.
  const cv::Mat gray = larger(cv::Rect(3, 2, 80, 50));
  const GraySampler sampler(gray);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d start(random.Uniform(20.0, 60.0), random.Uniform(20.0, 29.0));
    const Eigen::Vector2d step(random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0));
    std::vector<int> values(20);
    sampler.SampleRay(start, step, &values);
    for (int k = 0; k < 20; ++k) {
      // 1/2048 px in x and y, on edges of up to 255 grey levels.
      EXPECT_NEAR(static_cast<double>(values[static_cast<std::size_t>(k)]) / GraySampler::kRayUnit,
                  sampler.At(start + k * step),
                  0.25);
    }
  }
}

}  // namespace
}  // namespace plumb::test
