// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/image_gray.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cstring>

#include "plumbline/marker/marker_detector.h"
#include "ros/edge_blur.h"
#include "test/support/marker_scene.h"

namespace plumb::ros_adapter {
namespace {

constexpr int kSide_px = 8;
constexpr int kMiddle = kSide_px / 2;  // Away from the border, where colours cannot be told.

sensor_msgs::ImagePtr MakeImage(const std::string& encoding, int bytes_per_pixel) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->width = kSide_px;
  image->height = kSide_px;
  image->encoding = encoding;
  image->step = image->width * static_cast<std::uint32_t>(bytes_per_pixel);
  image->data.resize(image->step * image->height, 100);
  return image;
}

TEST(ToGrayPhoto, ReadsMonoColourAndBayer) {
  for (const auto& [encoding, bytes] : {std::pair("mono8", 1),
                                        std::pair("rgb8", 3),
                                        std::pair("bgra8", 4),
                                        std::pair("bayer_rggb8", 1)}) {
    const GrayPhoto photo = ToGrayPhoto(MakeImage(encoding, bytes));
    ASSERT_EQ(photo.problem, "") << encoding;
    EXPECT_EQ(photo.gray.size(), cv::Size(kSide_px, kSide_px));
    EXPECT_EQ(photo.gray.type(), CV_8UC1);
    EXPECT_NEAR(photo.gray.at<std::uint8_t>(kMiddle, kMiddle), 100, 1) << encoding;
  }
}

// 12 bits in 16 would be nearly black, were they taken for 16.
TEST(ToGrayPhoto, ScalesSixteenBitsByTheBitsInUse) {
  const auto image = MakeImage("mono16", 2);
  for (std::size_t i = 0; i < kSide_px * kSide_px; ++i) {
    const std::uint16_t value = i == 0 ? 4000 : 2048;
    std::memcpy(&image->data[2 * i], &value, 2);
  }
  const GrayPhoto photo = ToGrayPhoto(image);
  ASSERT_EQ(photo.problem, "");
  EXPECT_EQ(photo.gray.type(), CV_8UC1);
  EXPECT_NEAR(photo.gray.at<std::uint8_t>(kMiddle, kMiddle), 255.0 * 2048 / 4095, 1.0);
}

TEST(ToGrayPhoto, NamesWhatItCannotRead) {
  EXPECT_THAT(ToGrayPhoto(boost::make_shared<sensor_msgs::Image>()).problem,
              ::testing::HasSubstr("empty"));
  EXPECT_THAT(ToGrayPhoto(MakeImage("infrared7", 1)).problem, ::testing::HasSubstr("infrared7"));
  EXPECT_THAT(ToGrayPhoto(MakeImage("32FC1", 4)).problem, ::testing::HasSubstr("32FC1"));
  const auto cut = MakeImage("rgb8", 3);
  cut->data.resize(7);
  EXPECT_NE(ToGrayPhoto(cut).problem, "");
}

std::optional<double> BlurOf(double blur_px, double tilt_rad) {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 600.0;
  lens[kCx] = 159.5;
  lens[kCy] = 119.5;
  const Camera camera("camera", 320, 240, DistortionModel::kPlumbBob, lens);
  test::PhotoConditions conditions;
  conditions.blur_px = blur_px;
  const cv::Mat photo = test::RenderPhoto(
      camera,
      {{test::MarkerFace(5), test::PlaceMarker(camera, {150, 110}, 90, tilt_rad, 0.4, 1)}},
      conditions);
  return EdgeBlur_px(photo, DetectMarkers(MarkerDetectorOptions(), photo));
}

// The pixel's own area and the interpolation add some tenths to a small blur.
TEST(EdgeBlur, TellsTheBlurOfRenderedMarkers) {
  for (const double tilt_rad : {0.0, 0.7}) {
    EXPECT_NEAR(BlurOf(0.5, tilt_rad).value(), 0.75, 0.2);
    EXPECT_NEAR(BlurOf(1.0, tilt_rad).value(), 1.15, 0.2);
    EXPECT_NEAR(BlurOf(2.0, tilt_rad).value(), 2.1, 0.3);
  }
}

TEST(EdgeBlur, SaysNothingWithoutALargeMarker) {
  EXPECT_EQ(EdgeBlur_px(cv::Mat(100, 100, CV_8UC1, cv::Scalar(100)), {}), std::nullopt);
  MarkerDetection small;
  small.ellipse.center_px = {50.0, 50.0};
  small.ellipse.semi_major_px = small.ellipse.semi_minor_px = 5.0;
  EXPECT_EQ(EdgeBlur_px(cv::Mat(100, 100, CV_8UC1, cv::Scalar(100)), {small}), std::nullopt);
}

}  // namespace
}  // namespace plumb::ros_adapter
