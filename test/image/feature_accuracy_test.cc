// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>

#include "plumbline/image/photo_analysis.h"
#include "test/image/synthetic_photo.h"

namespace plumb {
namespace {

using testing::Blob;
using testing::Encode;
using testing::RenderBlobs;
using testing::RenderTexture;

constexpr int kWidth = 1000;  // Not a multiple of 16: the last blocks are cut.
constexpr int kHeight = 740;

// Options under which a photo of kWidth x kHeight is first decoded at eighths / 8.
FeatureOptions StartingAt(int eighths) {
  FeatureOptions options;
  options.max_features = 5000;  // Enough for what appears between the blobs, too.
  options.min_features = 1;
  options.min_fill = 0.0;
  options.max_blur = 1e6;
  options.pixels_per_feature =
      (eighths * eighths / 64.0 - 0.001) * kWidth * kHeight / options.max_features;
  return options;
}

// Blobs of one size at random sub-pixel positions, apart from each other and the border.
std::vector<Blob> ScatterBlobs(double sigma_px, double spacing, int seed) {
  std::mt19937 rng(static_cast<unsigned int>(seed));
  std::uniform_real_distribution<double> jitter(-1.0, 1.0);
  std::vector<Blob> blobs;
  for (double y = spacing; y < kHeight - spacing; y += spacing) {
    for (double x = spacing; x < kWidth - spacing; x += spacing) {
      blobs.push_back({{x + sigma_px * jitter(rng), y + sigma_px * jitter(rng)}, sigma_px});
    }
  }
  return blobs;
}

// The difference of Gaussians of s and k s answers most to a blob of sigma sqrt(k) s; here k is
// the cube root of 2.
double ExpectedScale(const Blob& blob) { return blob.sigma_px * std::exp2(-1.0 / 6.0); }

struct BlobErrors {
  int num_found = 0;
  Eigen::Vector2d bias_px = Eigen::Vector2d::Zero();
  double max_px = 0.0;
  double max_relative_scale = 0.0;
};

BlobErrors MeasureErrors(const std::vector<Blob>& blobs, const FeatureSet& set) {
  BlobErrors errors;
  for (const Blob& blob : blobs) {
    const auto distance = [&](const Feature& feature) {
      return (feature.Pixel() - blob.center_px).norm();
    };
    const auto nearest = std::min_element(
        set.features.begin(), set.features.end(), [&](const Feature& a, const Feature& b) {
          return distance(a) < distance(b);
        });
    if (nearest == set.features.end() || distance(*nearest) > blob.sigma_px) continue;
    ++errors.num_found;
    errors.bias_px += nearest->Pixel() - blob.center_px;
    errors.max_px = std::max(errors.max_px, distance(*nearest));
    errors.max_relative_scale =
        std::max(errors.max_relative_scale,
                 std::abs(static_cast<double>(nearest->scale_px) / ExpectedScale(blob) - 1.0));
  }
  errors.bias_px /= std::max(1, errors.num_found);
  return errors;
}

struct AccuracyCase {
  int eighths;
  std::string extension;
};

class SubPixelAccuracy : public ::testing::TestWithParam<AccuracyCase> {};

// The centre of a blob is where its difference of Gaussians is extreme, at a scale that goes with
// its sigma.
TEST_P(SubPixelAccuracy, FindsBlobsWhereTheyWereDrawn) {
  const double full_px_per_px = 8.0 / GetParam().eighths;
  const std::vector<Blob> blobs =
      ScatterBlobs(2.7 * full_px_per_px, 30.0 * full_px_per_px, /*seed=*/GetParam().eighths);
  const PhotoAnalysis analysis =
      AnalyzePhoto(StartingAt(GetParam().eighths),
                   Encode(RenderBlobs(blobs, kWidth, kHeight), GetParam().extension),
                   kWidth,
                   kHeight);
  ASSERT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
  const BlobErrors errors = MeasureErrors(blobs, analysis.features);
  EXPECT_EQ(errors.num_found, static_cast<int>(blobs.size()));
  EXPECT_LT(errors.bias_px.cwiseAbs().maxCoeff(), 0.01 * full_px_per_px);
  EXPECT_LT(errors.max_px, 0.05 * full_px_per_px);
  EXPECT_LT(errors.max_relative_scale, 0.06);
}

INSTANTIATE_TEST_SUITE_P(AllScales,
                         SubPixelAccuracy,
                         ::testing::Values(AccuracyCase{1, ".jpg"},
                                           AccuracyCase{2, ".jpg"},
                                           AccuracyCase{3, ".jpg"},
                                           AccuracyCase{4, ".jpg"},
                                           AccuracyCase{5, ".jpg"},
                                           AccuracyCase{8, ".jpg"},
                                           AccuracyCase{2, ".png"},
                                           AccuracyCase{3, ".png"},
                                           AccuracyCase{4, ".png"},
                                           AccuracyCase{8, ".png"}));

TEST(FinerOctaves, AreSearchedUpToDoubleResolutionWhereFeaturesAreFew) {
  const std::vector<Blob> blobs = ScatterBlobs(/*sigma_px=*/1.3, /*spacing=*/40.0, /*seed=*/7);
  FeatureOptions options = StartingAt(8);
  const std::vector<std::uint8_t> bytes = Encode(RenderBlobs(blobs, kWidth, kHeight), ".png");
  const BlobErrors coarse =
      MeasureErrors(blobs, AnalyzePhoto(options, bytes, kWidth, kHeight).features);
  options.min_fill = 1.0;
  const BlobErrors fine =
      MeasureErrors(blobs, AnalyzePhoto(options, bytes, kWidth, kHeight).features);
  EXPECT_LT(coarse.num_found, static_cast<int>(blobs.size()) / 10);
  EXPECT_EQ(fine.num_found, static_cast<int>(blobs.size()));
  EXPECT_LT(fine.bias_px.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT(fine.max_px, 0.1);
}

// Features of an image and of the same image seen through `moved_from_image`, matched by
// descriptor alone: how many match, and what part of them fits the motion.
struct Repeatability {
  int num_matches = 0;
  double fraction_right = 0.0;
  double median_error_px = 0.0;
  double median_turn_error_rad = 0.0;
};

Repeatability MeasureRepeatability(double turn_rad, double scale, const Eigen::Vector2d& shift_px) {
  const int size = 900;
  const cv::Mat image = RenderTexture(size, size, /*seed=*/3);
  // OpenCV's rotation is anticlockwise as seen, from x away from y.
  cv::Mat moved_from_image = cv::getRotationMatrix2D(
      cv::Point2f(size / 2.0F, size / 2.0F), -turn_rad * 180.0 / CV_PI, scale);
  moved_from_image.at<double>(0, 2) += shift_px.x();
  moved_from_image.at<double>(1, 2) += shift_px.y();
  cv::Mat moved;
  cv::warpAffine(
      image, moved, moved_from_image, image.size(), cv::INTER_LANCZOS4, cv::BORDER_REFLECT_101);
  FeatureOptions options;
  options.max_features = 1500;
  const PhotoAnalysis first = AnalyzePhoto(options, Encode(image, ".jpg"), size, size);
  const PhotoAnalysis second = AnalyzePhoto(options, Encode(moved, ".jpg"), size, size);

  const auto descriptors_of = [](const FeatureSet& set) {
    cv::Mat bytes(static_cast<int>(set.size()), kDescriptorSize, CV_8U);
    std::copy_n(set.descriptors.data(), set.descriptors.size(), bytes.data);
    bytes.convertTo(bytes, CV_32F);
    return bytes;
  };
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_L2, /*crossCheck=*/true)
      .match(descriptors_of(first.features), descriptors_of(second.features), matches);
  std::vector<double> errors_px;
  std::vector<double> turn_errors_rad;
  Repeatability result;
  for (const cv::DMatch& match : matches) {
    if (match.distance > 150.0F) continue;  // Of descriptors of length 512.
    ++result.num_matches;
    const Feature& a = first.features.features[static_cast<std::size_t>(match.queryIdx)];
    const Feature& b = second.features.features[static_cast<std::size_t>(match.trainIdx)];
    const cv::Mat expected =
        moved_from_image * cv::Mat(cv::Vec3d(a.Pixel().x(), a.Pixel().y(), 1.0));
    const Eigen::Vector2d expected_px(expected.at<double>(0), expected.at<double>(1));
    const double error_px = (b.Pixel() - expected_px).norm();
    if (error_px > 3.0) continue;
    errors_px.push_back(error_px);
    turn_errors_rad.push_back(std::abs(std::remainder(
        static_cast<double>(b.orientation_rad - a.orientation_rad) - turn_rad, 2.0 * CV_PI)));
  }
  const auto median = [](std::vector<double>* values) {
    if (values->empty()) return 1e9;
    std::sort(values->begin(), values->end());
    return (*values)[values->size() / 2];
  };
  result.fraction_right = static_cast<double>(errors_px.size()) / std::max(1, result.num_matches);
  result.median_error_px = median(&errors_px);
  result.median_turn_error_rad = median(&turn_errors_rad);
  return result;
}

TEST(Repeatability, SurvivesAShiftByPartsOfAPixel) {
  const Repeatability result = MeasureRepeatability(0.0, 1.0, {20.3, -10.6});
  EXPECT_GT(result.num_matches, 1000);
  EXPECT_GT(result.fraction_right, 0.97);
  EXPECT_LT(result.median_error_px, 0.1);
  EXPECT_LT(result.median_turn_error_rad, 0.03);
}

TEST(Repeatability, SurvivesARotation) {
  const Repeatability result = MeasureRepeatability(0.6, 1.0, {0.0, 0.0});
  EXPECT_GT(result.num_matches, 700);
  EXPECT_GT(result.fraction_right, 0.97);
  EXPECT_LT(result.median_error_px, 0.15);
  EXPECT_LT(result.median_turn_error_rad, 0.03);
}

TEST(Repeatability, SurvivesAQuarterTurn) {
  const Repeatability result = MeasureRepeatability(0.5 * CV_PI, 1.0, {0.0, 0.0});
  EXPECT_GT(result.num_matches, 1000);
  EXPECT_GT(result.fraction_right, 0.97);
  EXPECT_LT(result.median_error_px, 0.1);
  EXPECT_LT(result.median_turn_error_rad, 0.03);
}

TEST(Repeatability, SurvivesAChangeOfScale) {
  const Repeatability result = MeasureRepeatability(0.2, 1.4, {0.0, 0.0});
  EXPECT_GT(result.num_matches, 400);
  EXPECT_GT(result.fraction_right, 0.95);
  EXPECT_LT(result.median_error_px, 0.3);
  EXPECT_LT(result.median_turn_error_rad, 0.04);
}

}  // namespace
}  // namespace plumb
