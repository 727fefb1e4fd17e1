// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/marker_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "test/support/marker_scene.h"
#include "test/support/random.h"

namespace plumb::test {
namespace {

Camera MakeCamera(double k1 = 0.0) {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 800.0;
  lens[kCx] = 319.5;
  lens[kCy] = 239.5;
  lens[kK1] = k1;
  return Camera("test", 640, 480, DistortionModel::kPlumbBob, lens);
}

struct Shown {
  int id;
  Eigen::Vector2d center_px;
};

// A photo just large enough for one marker: what is done to it is tried many times.
const Eigen::Vector2d kOnlyCenter(80.3, 60.6);

cv::Mat OnlyMarker(int id, std::uint32_t seed) {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 800.0;
  lens[kCx] = 79.5;
  lens[kCy] = 59.5;
  const Camera camera("test", 160, 120, DistortionModel::kPlumbBob, lens);
  PhotoConditions conditions;
  conditions.samples_per_axis = 3;
  conditions.seed = seed;
  return RenderPhoto(camera,
                     {{MarkerFace(id), PlaceMarker(camera, kOnlyCenter, 60.0, 0.3, 1.0, 2.0)}},
                     conditions);
}

// A grid of 5 x 4 markers.
struct Scene {
  std::vector<PlacedFace> faces;
  std::vector<Shown> truth;
};

Scene MakeScene(const Camera& camera, double diameter_px, double tilt_rad, int seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d pixel(random.Uniform(60.0, 68.0) + 128.0 * (i % 5),
                                random.Uniform(56.0, 64.0) + 120.0 * (i / 5));
    const int id = random.Index(MarkerCodebook::Get().size());
    const double axis_rad = random.Uniform(0.0, 6.28);
    scene.faces.push_back(
        {MarkerFace(id),
         PlaceMarker(camera, pixel, diameter_px, tilt_rad, axis_rad, random.Uniform(0.0, 6.28))});
    scene.truth.push_back({id, pixel});
  }
  return scene;
}

// Mean error of the right ones [px]; each shown marker must be found and no other.
double MeanError(const std::vector<MarkerDetection>& detections, const std::vector<Shown>& truth) {
  EXPECT_EQ(detections.size(), truth.size());
  double sum = 0.0;
  for (const Shown& shown : truth) {
    double nearest = 1e9;
    for (const MarkerDetection& detection : detections) {
      if (detection.id != shown.id) continue;
      nearest = std::min(nearest, (detection.center_px - shown.center_px).norm());
    }
    EXPECT_LT(nearest, 1.0) << "marker " << shown.id << " at " << shown.center_px.transpose();
    sum += nearest / static_cast<double>(truth.size());
  }
  return sum;
}

TEST(DetectMarkers, FindsTheCentresOfASharpNoiseFreePhoto) {
  const Camera camera = MakeCamera();
  const Scene scene = MakeScene(camera, 50.0, 0.5, 1);
  PhotoConditions conditions;
  conditions.noise = 0.0;
  const cv::Mat gray = RenderPhoto(camera, scene.faces, conditions);
  // What is left are the model's straight edges: 0.01 px.
  EXPECT_LT(MeanError(DetectMarkers({}, gray), scene.truth), 0.01);
}

// It lets white grow over black, and a code has more black on one side than on the other: without
// regard to that the centres are off by 0.025 px here, and by 0.12 px on a simulated facade in the
// sun.
TEST(DetectMarkers, TheToneCurveDoesNotMoveTheCentre) {
  const Camera camera = MakeCamera();
  const Scene scene = MakeScene(camera, 50.0, 0.3, 4);
  PhotoConditions conditions;
  conditions.noise = 0.0;
  conditions.black = 6.0;
  conditions.white = 240.0;
  cv::Mat tones(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) {  // IEC 61966-2-1 (sRGB).
    const double tone = 1.055 * std::pow(i / 255.0, 1.0 / 2.4) - 0.055;
    tones.at<std::uint8_t>(i) = cv::saturate_cast<std::uint8_t>(255.0 * tone);
  }
  cv::Mat gray;
  cv::LUT(RenderPhoto(camera, scene.faces, conditions), tones, gray);
  EXPECT_LT(MeanError(DetectMarkers({}, gray), scene.truth), 0.01);
}

TEST(DetectMarkers, CorrectsThePerspectiveOfASteepTilt) {
  const Camera camera = MakeCamera();
  const Scene scene = MakeScene(camera, 40.0, 60.0 * M_PI / 180.0, 2);
  const cv::Mat gray = RenderPhoto(camera, scene.faces, {});
  const std::vector<MarkerDetection> detections = DetectMarkers({}, gray);
  EXPECT_LT(MeanError(detections, scene.truth), 0.05);
  double of_ellipses = 0.0;  // Which the correction takes away.
  for (const MarkerDetection& detection : detections) {
    of_ellipses += (detection.ellipse.center_px - detection.center_px).norm() / 20.0;
  }
  EXPECT_GT(of_ellipses, 0.1);
}

TEST(DetectMarkers, UndoesTheDistortionOfAKnownLens) {
  const Camera camera = MakeCamera(-0.25);
  const Scene scene = MakeScene(camera, 60.0, 0.4, 3);
  PhotoConditions conditions;
  conditions.noise = 1.0;
  const cv::Mat gray = RenderPhoto(camera, scene.faces, conditions);
  EXPECT_LT(MeanError(DetectMarkers({}, gray, &camera), scene.truth), 0.015);
}

TEST(DetectMarkers, ItsCovarianceIsThatOfItsErrors) {
  const Camera camera = MakeCamera();
  double sum = 0.0;
  int count = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    const Scene scene = MakeScene(camera, 24.0, 0.3, seed);
    PhotoConditions conditions;
    conditions.noise = 4.0;
    conditions.seed = static_cast<std::uint32_t>(seed);
    const cv::Mat gray = RenderPhoto(camera, scene.faces, conditions);
    for (const MarkerDetection& detection : DetectMarkers({}, gray)) {
      for (const Shown& shown : scene.truth) {
        const Eigen::Vector2d error = detection.center_px - shown.center_px;
        if (detection.id != shown.id || error.norm() > 2.0) continue;
        sum += error.dot(detection.center_covariance_px2.inverse() * error);
        ++count;
      }
    }
  }
  ASSERT_GE(count, 114);
  // Chi-square of two degrees of freedom; of 120 the mean has a standard deviation of 0.18.
  EXPECT_NEAR(sum / count, 2.0, 0.7);
}

TEST(DetectMarkers, TheHomographyTellsWhereTheMarkersPointsAre) {
  const Camera camera = MakeCamera();
  const Rigid3 cam_from_marker = PlaceMarker(camera, {300.2, 200.7}, 80.0, 0.6, 0.4, 1.1);
  const cv::Mat gray = RenderPhoto(camera, {{MarkerFace(7), cam_from_marker}}, {});
  const std::vector<MarkerDetection> detections = DetectMarkers({}, gray);
  ASSERT_EQ(detections.size(), 1U);
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, -0.8), Eigen::Vector2d(-0.4, 0.3)}) {
    const Eigen::Vector2d seen_px =
        (detections[0].pixel_from_marker * point.homogeneous()).hnormalized();
    const Eigen::Vector2d true_px =
        *camera.Project(cam_from_marker * Eigen::Vector3d(point.x(), point.y(), 0.0));
    EXPECT_LT((seen_px - true_px).norm(), 0.05);
  }
}

TEST(DetectMarkers, DoesNotDependOnTheNumberOfThreads) {
  const Camera camera = MakeCamera();
  const cv::Mat gray = RenderPhoto(camera, MakeScene(camera, 30.0, 0.5, 4).faces, {});
  MarkerDetectorOptions one;
  one.num_threads = 1;
  MarkerDetectorOptions many;
  many.num_threads = 4;
  const std::vector<MarkerDetection> a = DetectMarkers(one, gray);
  const std::vector<MarkerDetection> b = DetectMarkers(many, gray);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].center_px, b[i].center_px);
}

TEST(DetectMarkers, AMarkerThatIsThereTwiceIsFoundTwice) {
  const Camera camera = MakeCamera();
  const cv::Mat gray =
      RenderPhoto(camera,
                  {{MarkerFace(9), PlaceMarker(camera, {150.0, 200.0}, 40.0, 0.2, 0.0, 0.0)},
                   {MarkerFace(9), PlaceMarker(camera, {450.0, 300.0}, 30.0, 0.5, 1.0, 2.0)}},
                  {});
  const std::vector<MarkerDetection> detections = DetectMarkers({}, gray);
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].id, 9);
  EXPECT_EQ(detections[1].id, 9);
}

TEST(DetectMarkers, AnUntouchedOnlyMarkerIsFound) {  // Without which the tests below say nothing.
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const int id = Random(static_cast<int>(seed)).Index(MarkerCodebook::Get().size());
    const std::vector<MarkerDetection> detections = DetectMarkers({}, OnlyMarker(id, seed));
    ASSERT_EQ(detections.size(), 1U);
    EXPECT_EQ(detections[0].id, id);
  }
}

TEST(DetectMarkers, APartlyHiddenMarkerIsRightOrAbsent) {
  for (int i = 0; i < 60; ++i) {
    Random random(i);
    const int id = random.Index(MarkerCodebook::Get().size());
    cv::Mat gray = OnlyMarker(id, static_cast<std::uint32_t>(i));
    const double angle_rad = random.Uniform(0.0, 6.28);
    const double distance_px = random.Uniform(5.0, 60.0);
    cv::circle(gray,
               {80 + static_cast<int>(distance_px * std::cos(angle_rad)),
                60 + static_cast<int>(distance_px * std::sin(angle_rad))},
               8 + random.Index(20),
               cv::Scalar(random.Uniform(0.0, 255.0)),
               cv::FILLED);
    for (const MarkerDetection& detection : DetectMarkers({}, gray)) {
      EXPECT_EQ(detection.id, id);
      EXPECT_LT((detection.center_px - kOnlyCenter).norm(), 0.5);
    }
  }
}

TEST(DetectMarkers, AReflectionAcrossAMarkerYieldsTheRightIdOrNone) {
  for (int i = 0; i < 40; ++i) {
    Random random(i);
    const int id = random.Index(MarkerCodebook::Get().size());
    const cv::Mat gray = OnlyMarker(id, static_cast<std::uint32_t>(i));
    cv::Mat glare(gray.size(), CV_8U, cv::Scalar(0));
    const int x = 50 + random.Index(60);
    cv::line(glare, {x, -30}, {160 - x, 150}, cv::Scalar(200), 4 + random.Index(20));
    cv::GaussianBlur(glare, glare, {0, 0}, 4.0);
    for (const MarkerDetection& detection : DetectMarkers({}, gray + glare)) {
      EXPECT_EQ(detection.id, id);
    }
  }
}

TEST(DetectMarkers, AMarkerInAMirrorIsNoOtherMarker) {
  for (int id = 0; id < MarkerCodebook::Get().size(); id += 3) {
    cv::Mat mirrored;
    cv::flip(OnlyMarker(id, static_cast<std::uint32_t>(id)), mirrored, 1);
    for (const MarkerDetection& detection : DetectMarkers({}, mirrored)) {
      EXPECT_EQ(detection.id, id);  // Some codes are their own mirror images.
    }
  }
}

// Small, blurred, noisy: such ones were read as another's ID, or parts of them as markers.
TEST(DetectMarkers, WhatCannotBeReadIsNotGuessed) {
  struct Hard {
    double diameter_px;
    double blur_px;
    double noise;
    double white;
  };
  const Camera camera = MakeCamera();
  for (const Hard& hard : {Hard{16.0, 1.2, 4.0, 120.0},
                           Hard{24.0, 2.0, 2.0, 220.0},
                           Hard{24.0, 2.5, 2.0, 220.0},
                           Hard{40.0, 4.0, 2.0, 220.0}}) {
    for (int seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(seed);
      const Scene scene = MakeScene(camera, hard.diameter_px, 0.0, seed);
      PhotoConditions conditions;
      conditions.samples_per_axis = 3;
      conditions.blur_px = hard.blur_px;
      conditions.noise = hard.noise;
      conditions.black = 60.0;
      conditions.white = hard.white;
      conditions.seed = static_cast<std::uint32_t>(seed);
      const cv::Mat gray = RenderPhoto(camera, scene.faces, conditions);
      for (const MarkerDetection& detection : DetectMarkers({}, gray)) {
        EXPECT_TRUE(std::any_of(scene.truth.begin(),
                                scene.truth.end(),
                                [&](const Shown& shown) {
                                  return shown.id == detection.id &&
                                         (shown.center_px - detection.center_px).norm() < 3.0;
                                }))
            << "marker " << detection.id << " at " << detection.center_px.transpose();
      }
    }
  }
}

TEST(DetectMarkers, SurvivesStrongVignetting) {
  const Camera camera = MakeCamera();
  const Scene scene = MakeScene(camera, 40.0, 0.3, 6);
  const cv::Mat gray = RenderPhoto(camera, scene.faces, {});
  cv::Mat dim = gray.clone();
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      const double radius2 = (std::pow(x - 320.0, 2) + std::pow(y - 240.0, 2)) / 160000.0;
      dim.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(gray.at<std::uint8_t>(y, x) * (1.0 - 0.7 * radius2));
    }
  }
  EXPECT_LT(MeanError(DetectMarkers({}, dim), scene.truth), 0.03);
}

TEST(DetectMarkers, AMarkerOfNegativeContrastIsNone) {
  EXPECT_THAT(DetectMarkers({}, 255 - OnlyMarker(3, 1)), testing::IsEmpty());
}

TEST(DetectMarkers, FindsNothingInNoiseInBlankPhotosAndInTinyOnes) {
  cv::Mat noise(480, 640, CV_8U);
  cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 256);
  EXPECT_THAT(DetectMarkers({}, noise), testing::IsEmpty());
  EXPECT_THAT(DetectMarkers({}, cv::Mat(480, 640, CV_8U, cv::Scalar(77))), testing::IsEmpty());
  EXPECT_THAT(DetectMarkers({}, cv::Mat(1, 1, CV_8U, cv::Scalar(0))), testing::IsEmpty());
  EXPECT_THAT(DetectMarkers({}, cv::Mat(3, 900, CV_8U, cv::Scalar(0))), testing::IsEmpty());
}

TEST(DetectMarkers, AMarkerAcrossTheEdgeOfThePhotoDoesNoHarm) {
  const cv::Mat gray = OnlyMarker(11, 1);
  for (int cut = 45; cut < 115; cut += 3) {
    for (const MarkerDetection& detection :
         DetectMarkers({}, gray(cv::Rect(cut, 0, 160 - cut, 120)).clone())) {
      EXPECT_EQ(detection.id, 11);
    }
  }
}

TEST(DetectMarkers, RefusesWhatItCannotRead) {
  const Camera camera = MakeCamera();
  EXPECT_THROW(DetectMarkers({}, cv::Mat()), std::invalid_argument);
  EXPECT_THROW(DetectMarkers({}, cv::Mat(480, 640, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(DetectMarkers({}, cv::Mat(480, 600, CV_8U, cv::Scalar(0)), &camera),
               std::invalid_argument);
  MarkerDetectorOptions options;
  options.min_contrast = 0.0;
  EXPECT_THROW(DetectMarkers(options, cv::Mat(480, 640, CV_8U, cv::Scalar(0))),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumb::test
