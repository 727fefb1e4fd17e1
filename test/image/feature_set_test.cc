// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plumbline/image/photo_analysis.h"
#include "test/image/synthetic_photo.h"

namespace plumb {
namespace {

using testing::Blob;
using testing::Encode;
using testing::RenderBlobs;
using testing::RenderTexture;

constexpr int kWidth = 960;
constexpr int kHeight = 720;

PhotoAnalysis AnalyzeTexture(const FeatureOptions& options) {
  static const std::vector<std::uint8_t> bytes =
      Encode(RenderTexture(kWidth, kHeight, /*seed=*/1), ".jpg");
  return AnalyzePhoto(options, bytes, kWidth, kHeight);
}

TEST(FeatureSet, HoldsNoMoreThanAskedForAndAllWhereThereAreEnough) {
  for (const int max_features : {100, 777, 2000}) {
    FeatureOptions options;
    options.max_features = max_features;
    const FeatureSet features = AnalyzeTexture(options).features;
    EXPECT_EQ(static_cast<int>(features.size()), max_features);
    EXPECT_EQ(features.descriptors.rows(), max_features);
    EXPECT_EQ(static_cast<int>(features.colors.size()), max_features);
  }
}

TEST(FeatureSet, DescendsInScale) {
  const FeatureSet set = AnalyzeTexture({}).features;
  ASSERT_GT(set.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(set.features.begin(), set.features.end(), [](auto& a, auto& b) {
    return a.scale_px > b.scale_px;
  }));
}

TEST(FeatureSet, LiesInThePhoto) {
  for (const Feature& feature : AnalyzeTexture({}).features.features) {
    EXPECT_GE(feature.x_px, -0.5F);
    EXPECT_LE(feature.x_px, kWidth - 0.5F);
    EXPECT_GE(feature.y_px, -0.5F);
    EXPECT_LE(feature.y_px, kHeight - 0.5F);
    EXPECT_LE(std::abs(feature.orientation_rad), 3.1416F);
  }
}

TEST(FeatureSet, HasDescriptorsOfLength512) {
  const DescriptorMatrix descriptors = AnalyzeTexture({}).features.descriptors;
  const Eigen::VectorXd lengths = descriptors.cast<double>().rowwise().norm();
  EXPECT_GT(lengths.minCoeff(), 500.0);
  EXPECT_LT(lengths.maxCoeff(), 516.0);  // Of rounding.
}

TEST(FeatureSet, DoesNotDependOnTheNumberOfThreads) {
  FeatureOptions options;
  options.num_threads = 1;
  const PhotoAnalysis one = AnalyzeTexture(options);
  for (const int num_threads : {0, 2, 5}) {
    options.num_threads = num_threads;
    const PhotoAnalysis other = AnalyzeTexture(options);
    ASSERT_EQ(one.features.size(), other.features.size());
    EXPECT_EQ(one.features.descriptors, other.features.descriptors);
    EXPECT_EQ(one.features.colors, other.features.colors);
    EXPECT_EQ(one.blur_px, other.blur_px);
    for (std::size_t i = 0; i < one.features.size(); ++i) {
      EXPECT_EQ(one.features.features[i].Pixel(), other.features.features[i].Pixel());
    }
  }
}

// Everything large is in one corner: 2000 blobs, against 250 smaller ones in the rest.
TEST(FeatureSet, IsNotEatenByACluster) {
  std::mt19937 rng(5);
  const auto scatter = [&](int count, double sigma_px, double begin_x, double end_x) {
    std::uniform_real_distribution<double> x(begin_x, end_x);
    std::uniform_real_distribution<double> y(20.0, kHeight - 20.0);
    std::vector<Blob> blobs;
    for (int i = 0; i < count; ++i) blobs.push_back({{x(rng), y(rng)}, sigma_px});
    return blobs;
  };
  std::vector<Blob> blobs = scatter(2000, 4.0, 0.0, 0.25 * kWidth);
  const std::vector<Blob> rest = scatter(250, 3.0, 0.3 * kWidth, kWidth - 20.0);
  blobs.insert(blobs.end(), rest.begin(), rest.end());
  FeatureOptions options;
  options.max_features = 500;
  options.pixels_per_feature = 1000.0;
  const FeatureSet set =
      AnalyzePhoto(options, Encode(RenderBlobs(blobs, kWidth, kHeight), ".png"), kWidth, kHeight)
          .features;
  ASSERT_EQ(set.size(), 500U);
  const auto num_in_rest =
      std::count_if(set.features.begin(), set.features.end(), [](const Feature& feature) {
        return feature.x_px > 0.28F * kWidth;
      });
  EXPECT_GT(num_in_rest, 150);  // A round blob may have two orientations, hence two features.
}

TEST(FeatureSet, HasThePhotosColors) {
  cv::Mat image = RenderTexture(kWidth, kHeight, /*seed=*/2);
  cv::Mat gray;
  cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
  cv::Mat zero = cv::Mat::zeros(gray.size(), CV_8U);
  cv::merge(std::vector<cv::Mat>{zero, gray * 0.5, gray}, image);  // Orange.
  for (const char* extension : {".jpg", ".png"}) {
    const PhotoAnalysis analysis = AnalyzePhoto({}, Encode(image, extension), kWidth, kHeight);
    ASSERT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Rgb& color : analysis.features.colors) {
      mean += Eigen::Vector3d(color[0], color[1], color[2]) /
              static_cast<double>(analysis.features.size());
    }
    EXPECT_NEAR(mean[0], 128.0, 30.0) << extension;
    EXPECT_NEAR(mean[1], 0.5 * mean[0], 4.0) << extension;
    EXPECT_NEAR(mean[2], 0.0, 8.0) << extension;
  }
}

TEST(FeatureOptions, NamesEveryViolatedBound) {
  EXPECT_TRUE(FeatureOptions().Problems().empty());
  FeatureOptions options;
  options.max_features = 0;
  options.num_threads = -1;
  options.min_contrast = 0.0;
  EXPECT_THAT(options.Problems(),
              ::testing::IsSupersetOf({::testing::HasSubstr("max_features"),
                                       ::testing::HasSubstr("num_threads"),
                                       ::testing::HasSubstr("min_contrast")}));
  EXPECT_THROW(AnalyzePhoto(options, {}, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
