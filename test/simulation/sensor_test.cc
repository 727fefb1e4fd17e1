// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "plumbline/image/photo_metadata.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

constexpr int kWidth = 600;
constexpr int kHeight = 400;

// No blur, no noise, linear: what comes in comes out.
SensorOptions Ideal() {
  SensorOptions options;
  options.vignetting = 0.0;
  options.lens_blur_px = 0.0;
  options.motion_blur = false;
  options.noise = false;
  options.tone_curve = false;
  return options;
}

cv::Mat Flat(double radiance, int width = kWidth, int height = kHeight) {
  return {height, width, CV_32FC3, cv::Scalar::all(radiance)};
}

// A picture in which no two values are alike.
cv::Mat Uneven() {
  cv::Mat radiance = Flat(0.0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double wave = std::sin(0.13 * x) * std::cos(0.07 * y);
      radiance.at<cv::Vec3f>(y, x) = cv::Vec3d(0.4 + 0.3 * wave, 0.3, 0.5 - 0.2 * wave);
    }
  }
  return radiance;
}

Exposure Neutral(int iso = 100) { return {0.001, iso, 1.0}; }

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};
Moments Measure(const cv::Mat& picture) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(picture.reshape(1), mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(ExposePhoto, KeepsTheLightOfAnIdealCamera) {
  const cv::Mat picture =
      ExposePhoto(Ideal(), test::MakeCamera(), Flat(0.4), Neutral(), ShotConditions());
  EXPECT_EQ(Measure(picture).mean, 102.0);
  EXPECT_EQ(Measure(picture).deviation, 0.0);
}

TEST(ExposePhoto, ToneCurveIsSrgb) {
  SensorOptions options = Ideal();
  options.tone_curve = true;
  const Camera camera = test::MakeCamera();
  // Mid grey of 18 % is 118 in sRGB; white clips.
  EXPECT_EQ(Measure(ExposePhoto(options, camera, Flat(0.18), Neutral(), ShotConditions())).mean,
            118.0);
  EXPECT_EQ(Measure(ExposePhoto(options, camera, Flat(3.0), Neutral(), ShotConditions())).mean,
            255.0);
}

TEST(ExposePhoto, VignettingDarkensTheCornersByItsShare) {
  SensorOptions options = Ideal();
  options.vignetting = 0.4;
  const cv::Mat picture =
      ExposePhoto(options, test::MakeCamera(), Flat(0.8), Neutral(), ShotConditions());
  EXPECT_NEAR(picture.at<cv::Vec3b>(kHeight / 2, kWidth / 2)[1], 204, 1);
  EXPECT_NEAR(picture.at<cv::Vec3b>(0, 0)[1], 0.6 * 204, 1);
  EXPECT_NEAR(picture.at<cv::Vec3b>(kHeight - 1, kWidth - 1)[2], 0.6 * 204, 1);
}

// Law: the variance of the electrons is their number, plus that of reading.
TEST(ExposePhoto, NoiseFollowsLightAndSensitivity) {
  SensorOptions options = Ideal();
  options.noise = true;
  const Camera camera = test::MakeCamera();
  for (const int iso : {400, 3200}) {
    for (const double signal : {0.2, 0.6}) {
      const double electrons = options.full_well_electrons * 100.0 / iso;
      const double read = options.read_noise_electrons / electrons;
      const double expected2 = signal / electrons + read * read + 1.0 / (12.0 * 255.0 * 255.0);
      const Moments moments =
          Measure(ExposePhoto(options, camera, Flat(signal), Neutral(iso), ShotConditions()));
      EXPECT_NEAR(moments.mean, 255.0 * signal, 0.2);
      EXPECT_NEAR(moments.deviation, 255.0 * std::sqrt(expected2), 0.02 * moments.deviation);
    }
  }
}

TEST(ExposePhoto, TakesLightBelowZeroForNone) {
  cv::Mat radiance = Flat(0.2);
  radiance.at<cv::Vec3f>(20, 30) = {-0.01F, 0.2F, NAN};
  SensorOptions options;
  options.motion_blur = false;
  options.lens_blur_px = 0.0;
  const cv::Mat picture = ExposePhoto(options, test::MakeCamera(), radiance, Neutral(), {});
  EXPECT_LT(picture.at<cv::Vec3b>(20, 30)[0], 10);
  EXPECT_GT(picture.at<cv::Vec3b>(20, 30)[1], 50);
  EXPECT_LT(picture.at<cv::Vec3b>(20, 30)[2], 10);
}

TEST(ExposePhoto, NoiseIsAnotherOneInEachPhotoAndTheSameOnAnyNumberOfThreads) {
  SensorOptions options;
  options.max_iso = 6400;
  ShotConditions conditions;
  conditions.velocity_in_cam_m_s = {3.0, 1.0, 0.0};
  const Camera camera = test::MakeCamera();
  const cv::Mat one = ExposePhoto(options, camera, Uneven(), Neutral(1600), conditions, 1);
  const cv::Mat two = ExposePhoto(options, camera, Uneven(), Neutral(1600), conditions, 2);
  EXPECT_EQ(cv::norm(one, two, cv::NORM_INF), 0.0);
  conditions.noise_seed = 1;
  const cv::Mat other = ExposePhoto(options, camera, Uneven(), Neutral(1600), conditions, 2);
  EXPECT_GT(cv::norm(one, other, cv::NORM_L1) / static_cast<double>(one.total()), 3.0);
}

TEST(ExposePhoto, BlurKeepsAPointWhereItIs) {
  SensorOptions options = Ideal();
  options.lens_blur_px = 1.2;
  options.motion_blur = true;
  ShotConditions conditions;
  conditions.velocity_in_cam_m_s = {10.0, -4.0, 0.0};
  cv::Mat radiance = Flat(0.0);
  radiance.at<cv::Vec3f>(200, 300) = {8.0F, 8.0F, 8.0F};
  const cv::Mat picture = ExposePhoto(options, test::MakeCamera(), radiance, Neutral(), conditions);
  cv::Mat green;
  cv::extractChannel(picture, green, 1);
  const cv::Moments moments = cv::moments(green);
  EXPECT_NEAR(moments.m10 / moments.m00, 300.0, 0.02);
  EXPECT_NEAR(moments.m01 / moments.m00, 200.0, 0.02);
}

// Law: the kernel spreads a point along the way that the camera model sends it.
TEST(BlurKernel, SpreadsAlongTheWayOfAProjectedPoint) {
  const Camera camera = test::MakeCamera();
  ShotConditions conditions;
  conditions.velocity_in_cam_m_s = {4.0, 2.0, 0.0};
  conditions.turn_rate_in_cam_rad_s = {0.3, -0.5, 0.0};
  conditions.scene_distance_m = 8.0;
  const Exposure exposure{0.01, 100, 1.0};
  SensorOptions options;
  options.lens_blur_px = 0.8;

  const auto seen_at = [&](double time_s) {
    const Eigen::Vector3d turn = time_s * conditions.turn_rate_in_cam_rad_s;
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    const Eigen::Vector3d point(0.0, 0.0, conditions.scene_distance_m);
    return *camera.Project(turned.conjugate() * (point - time_s * conditions.velocity_in_cam_m_s));
  };
  const Eigen::Vector2d way = seen_at(0.005) - seen_at(-0.005);

  const cv::Mat kernel = BlurKernel(options, camera, exposure, conditions);
  EXPECT_NEAR(cv::sum(kernel)[0], 1.0, 1e-6);
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int y = 0; y < kernel.rows; ++y) {
    for (int x = 0; x < kernel.cols; ++x) {
      const Eigen::Vector2d from(x - kernel.cols / 2, y - kernel.rows / 2);
      covariance += kernel.at<float>(y, x) * from * from.transpose();
    }
  }
  const Eigen::Matrix2d expected =
      way * way.transpose() / 12.0 + 0.8 * 0.8 * Eigen::Matrix2d::Identity();
  EXPECT_LT((covariance - expected).norm(), 0.02 * expected.norm());
}

TEST(BlurKernel, DefocusGrowsAwayFromTheFocus) {
  SensorOptions options;
  options.lens_blur_px = 0.0;
  options.focus_distance_m = 4.0;
  ShotConditions conditions;
  conditions.scene_distance_m = 4.0;
  EXPECT_EQ(BlurKernel(options, test::MakeCamera(), Neutral(), conditions).total(), 1U);
  // f = 16 mm at f/5.6, focused at 4 m: at 1 m the disc is 34.4 um; this lens maps 16 mm to
  // 2500 px, so it is 5.4 px wide, which a Gaussian of a quarter of that stands for.
  conditions.scene_distance_m = 1.0;
  const cv::Mat kernel = BlurKernel(options, test::MakeCamera(), Neutral(), conditions);
  const double peak = kernel.at<float>(kernel.rows / 2, kernel.cols / 2);
  EXPECT_NEAR(std::sqrt(1.0 / (2.0 * 3.14159265 * peak)), 5.38 / 4.0, 0.02);
}

TEST(MeterExposure, AimsAtMidGreyAndRaisesSensitivityLast) {
  const SensorOptions options;
  const Exposure sunny = MeterExposure(options, Flat(0.4));
  EXPECT_EQ(sunny.iso, options.min_iso);
  EXPECT_LT(sunny.time_s, options.max_exposure_s);
  EXPECT_LE(0.4 * sunny.gain, options.metering_target);
  EXPECT_GT(0.4 * sunny.gain, options.metering_target / 1.27);  // Thirds of a stop.
  const Exposure shady = MeterExposure(options, Flat(0.01));
  EXPECT_EQ(shady.time_s, options.max_exposure_s);
  EXPECT_GT(shady.iso, options.min_iso);
  const Exposure night = MeterExposure(options, Flat(0.0));
  EXPECT_EQ(night.iso, options.max_iso);
}

TEST(EncodePhoto, TellsItsExifAndItsPicture) {
  const SensorOptions options;
  const cv::Mat picture =
      ExposePhoto(Ideal(), test::MakeCamera(), Uneven(), Neutral(), ShotConditions());
  PhotoTags tags;
  tags.exposure_time = Timestamp{1'717'236'005'043'210'000};
  tags.position = GeodeticPosition{-47.0581234567, 15.4577654321, -12.345};
  const std::vector<std::uint8_t> file = EncodePhoto(options, picture, {0.00125, 200, 1.0}, tags);
  const PhotoMetadata metadata = ReadPhotoMetadata(file);
  EXPECT_EQ(metadata.width_px, kWidth);
  EXPECT_EQ(metadata.height_px, kHeight);
  EXPECT_EQ(metadata.focal_length_mm, 16.0);
  EXPECT_EQ(metadata.exposure_time, tags.exposure_time);
  ASSERT_TRUE(metadata.position);
  EXPECT_NEAR(metadata.position->lat_deg, tags.position->lat_deg, 1e-9);
  EXPECT_NEAR(metadata.position->lon_deg, tags.position->lon_deg, 1e-9);
  EXPECT_NEAR(metadata.position->alt_m.value_or(0.0), -12.345, 1e-3);
  const cv::Mat decoded = cv::imdecode(file, cv::IMREAD_COLOR);
  EXPECT_LT(cv::norm(decoded, picture, cv::NORM_L1) / static_cast<double>(picture.total() * 3), 3);
  EXPECT_EQ(EncodePhoto(options, picture, {0.00125, 200, 1.0}, tags), file);
}

TEST(SensorOptions, ListEveryProblem) {
  SensorOptions options;
  options.f_number = 0.0;
  options.max_iso = 50;
  options.jpeg_quality = 0;
  EXPECT_THAT(options.Problems(),
              testing::ElementsAre(testing::HasSubstr("f_number"),
                                   testing::HasSubstr("max_iso"),
                                   testing::HasSubstr("jpeg_quality must be in [1, 100]")));
  EXPECT_THROW(MeterExposure(options, Flat(0.5)), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
