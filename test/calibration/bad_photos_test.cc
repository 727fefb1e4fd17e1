// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What people do wrong: no crash, no wrong result passed as good, and a message that says what to
// do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "test/calibration/calibration_checks.h"

namespace plumb {
namespace {

using test::CalibrationSceneOptions;
using test::FindingOf;
using test::FocalErrorPercent;
using test::Kind;
using test::MakeCalibrationPhotos;
using test::QuickOptions;
using test::TextOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<test::ScenePlate> Strewn(int seed) {
  test::Random random(seed);
  return test::StrewnPlates(&random);
}

TEST(BadPhotos, NoneOneOrTwoAreTooFew) {
  const std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos();
  for (std::size_t count = 0; count <= 2; ++count) {
    const CalibrationResult result = CalibrateCamera(
        QuickOptions(), {photos.begin(), photos.begin() + static_cast<long>(count)});
    EXPECT_EQ(result.verdict, CalibrationVerdict::kFailed);
    EXPECT_FALSE(result.estimate);
    ASSERT_TRUE(FindingOf(result, Kind::kTooFewPhotos)) << TextOf(result);
    EXPECT_THAT(TextOf(result), HasSubstr("from all sides"));
    EXPECT_FALSE(FindingOf(result, Kind::kTooFewMarkers)) << TextOf(result);
  }
}

TEST(BadPhotos, AllFromOneSpotAreNotGood) {
  const CalibrationSceneOptions scene;
  const std::vector<test::ScenePlate> plates = Strewn(3);
  test::Random random(1);
  std::vector<CalibrationPhoto> photos;
  const Rigid3 cam_from_plane = test::CalibrationPose(scene, 13.0, 4, &random);
  for (int i = 0; i < 12; ++i) {
    photos.push_back(SeePlates(scene, plates, cam_from_plane, std::to_string(i), &random));
  }
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  EXPECT_NE(result.verdict, CalibrationVerdict::kGood);
  EXPECT_THAT(
      result.advice,
      testing::AnyOf(
          HasSubstr("Move around"), HasSubstr("from the side"), HasSubstr("from all sides")))
      << TextOf(result);
}

TEST(BadPhotos, AllSquareFromAboveDoNotTellTheFocalLength) {
  CalibrationSceneOptions scene;
  const std::vector<test::ScenePlate> plates = Strewn(3);
  test::Random random(1);
  std::vector<CalibrationPhoto> photos;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Quaterniond down(0.0, 1.0, 0.0, 0.0);
    const Rigid3 cam_from_plane(down, {0.3 * i - 1.0, 0.5, 10.0 + i});
    photos.push_back(SeePlates(scene, plates, cam_from_plane, std::to_string(i), &random));
  }
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  EXPECT_NE(result.verdict, CalibrationVerdict::kGood);
  EXPECT_THAT(TextOf(result), testing::AnyOf(HasSubstr("tilt"), HasSubstr("No lens")))
      << TextOf(result);
}

TEST(BadPhotos, AMarkerTwiceInOnePhotoIsLeftOutThere) {
  const CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  MarkerDetection twin = photos[2].markers[0];
  twin.center_px += Eigen::Vector2d(200.0, 90.0);
  photos[2].markers.push_back(twin);
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto finding = FindingOf(result, Kind::kMarkerTwice);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->marker_ids, ElementsAre(twin.id));
  EXPECT_THAT(finding->photos, ElementsAre("3.jpg"));
  EXPECT_THAT(finding->text, HasSubstr("--first-id"));
}

TEST(BadPhotos, TwoSheetsOfTheSameIdsInEveryPhotoFailAndSaySo) {
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos();
  for (CalibrationPhoto& photo : photos) {
    const std::vector<MarkerDetection> once = photo.markers;
    for (MarkerDetection twin : once) {
      twin.center_px += Eigen::Vector2d(35.0, 10.0);
      photo.markers.push_back(twin);
    }
  }
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  EXPECT_EQ(result.verdict, CalibrationVerdict::kFailed);
  EXPECT_THAT(result.advice, HasSubstr("two sheets with the same IDs")) << TextOf(result);
}

TEST(BadPhotos, TwoArrangementsOfTheSameIdsAreNotGood) {
  const CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = test::PhotographPlates(scene, Strewn(3));
  const std::vector<CalibrationPhoto> others = test::PhotographPlates(scene, Strewn(4));
  std::vector<test::ScenePlate> shuffled = Strewn(4);
  std::reverse(shuffled.begin(), shuffled.end());
  for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i].id = static_cast<int>((i * 7) % 16);
  const std::vector<CalibrationPhoto> mixed = test::PhotographPlates(scene, shuffled);
  for (std::size_t i = 6; i < photos.size(); ++i) photos[i] = mixed[i];
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  EXPECT_NE(result.verdict, CalibrationVerdict::kGood);
  EXPECT_THAT(TextOf(result),
              testing::AnyOf(HasSubstr("same IDs"), HasSubstr("moved"), HasSubstr("arrangement")))
      << TextOf(result);
}

TEST(BadPhotos, AMarkerMovedHalfWayIsNamedWithItsPhotos) {
  CalibrationSceneOptions scene;
  std::vector<test::ScenePlate> plates = Strewn(3);
  std::vector<CalibrationPhoto> photos = test::PhotographPlates(scene, plates);
  plates[5].center += Eigen::Vector3d(0.3, -0.2, 0.0);
  const std::vector<CalibrationPhoto> later = test::PhotographPlates(scene, plates);
  for (std::size_t i = 8; i < photos.size(); ++i) photos[i] = later[i];
  CalibrationOptions options = QuickOptions();
  options.marker_diameter_m = 0.1;
  const CalibrationResult result = CalibrateCamera(options, photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto finding = FindingOf(result, Kind::kMoved);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->marker_ids, ElementsAre(5));
  EXPECT_THAT(finding->text, HasSubstr("36.")) << "0.36 of 100 mm";
  for (const std::string& name : finding->photos) EXPECT_GE(std::stoi(name), 9) << finding->text;
  EXPECT_FALSE(finding->is_serious);
}

TEST(BadPhotos, OtherSizesAreLeftOutAndNamed) {
  const CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  std::swap(photos[1].width_px, photos[1].height_px);
  photos[4].width_px = 640;
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto finding = FindingOf(result, Kind::kMixedSizes);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->photos, ElementsAre("2.jpg", "5.jpg"));
  EXPECT_FALSE(result.photos[1].is_used);
}

// A marker on a wall, seen in a wet floor: it stands below the plane in all photos that show it.
TEST(BadPhotos, AReflectionDoesNotBendThePlane) {
  CalibrationSceneOptions scene;
  std::vector<test::ScenePlate> plates = Strewn(3);
  plates.push_back({20, {3.0, 1.0, -3.0}, 0.4});
  const CalibrationResult result =
      CalibrateCamera(QuickOptions(), test::PhotographPlates(scene, plates));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto off_plane = FindingOf(result, Kind::kOffPlane);
  const auto moved = FindingOf(result, Kind::kMoved);
  ASSERT_TRUE(off_plane || moved) << TextOf(result);
  EXPECT_THAT((off_plane ? *off_plane : *moved).marker_ids, ElementsAre(20));
}

// A highlight that wanders with the camera reads as a marker here and there.
TEST(BadPhotos, AWanderingGhostIsNamed) {
  CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  for (std::size_t i = 0; i < photos.size(); i += 2) {
    MarkerDetection ghost = photos[i].markers[0];
    ghost.id = 40;
    ghost.center_px = {300.0 + 110.0 * static_cast<double>(i),
                       1200.0 - 90.0 * static_cast<double>(i)};
    photos[i].markers.push_back(ghost);
  }
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  EXPECT_THAT(TextOf(result), HasSubstr("arker 40")) << TextOf(result);
}

TEST(BadPhotos, PartlyHiddenMarkersAreLeftOutAndNamed) {
  CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  photos[1].markers[2].center_px += Eigen::Vector2d(1.5, -0.7);
  photos[6].markers[3].center_px += Eigen::Vector2d(-1.0, 0.9);
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto finding = FindingOf(result, Kind::kWrongView);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->photos, ElementsAre("2.jpg", "7.jpg"));
}

TEST(BadPhotos, StrewnMarkersAreNoFixedGrid) {
  CalibrationOptions options = QuickOptions();
  options.fixed_grid = "a4";
  const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos());
  EXPECT_NE(result.verdict, CalibrationVerdict::kGood);
  EXPECT_THAT(TextOf(result), HasSubstr("without a fixed grid")) << TextOf(result);
}

TEST(BadPhotos, MarkersThatAreNotOnTheGridAreNamed) {
  CalibrationOptions options = QuickOptions();
  options.fixed_grid = "a4";
  options.first_id = 50;
  const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos());
  EXPECT_EQ(result.verdict, CalibrationVerdict::kFailed);
  EXPECT_THAT(result.advice, HasSubstr("first ID")) << TextOf(result);
}

TEST(BadPhotos, NumbersThatAreNoneAreLeftOut) {
  const CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  photos[0].markers[0].center_px.x() = std::numeric_limits<double>::quiet_NaN();
  photos[1].markers[1].center_covariance_px2(0, 0) = std::numeric_limits<double>::infinity();
  photos[2].markers[2].ellipse.semi_minor_px = 0.0;
  photos[3].markers[3].ellipse.angle_rad = std::numeric_limits<double>::infinity();
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
}

TEST(BadPhotos, TheSamePhotoTwiceCountsOnce) {
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos();
  photos.push_back(photos[0]);
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(FindingOf(result, Kind::kSameName)) << TextOf(result);
  EXPECT_FALSE(result.photos.back().is_used);
}

// Cut off at the borders, blurred, half covered: three markers a photo are no pose.
TEST(BadPhotos, PhotosWithFewMarkersAreNamed) {
  const CalibrationSceneOptions scene;
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos(scene);
  photos[5].markers.resize(3);
  const CalibrationResult result = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(result.estimate) << TextOf(result);
  const auto finding = FindingOf(result, Kind::kTooFewMarkers);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->photos, ElementsAre("6.jpg"));
}

// Whatever is thrown at it: no crash, and never "good" far off the truth.
TEST(BadPhotos, RandomRubbishIsNeverPassedAsGood) {
  test::Random random(7);
  const CalibrationSceneOptions scene;
  const std::vector<CalibrationPhoto> sound = MakeCalibrationPhotos(scene);
  CalibrationOptions options = QuickOptions();
  options.num_focal_steps = 8;
  for (int round = 0; round < 10; ++round) {
    std::vector<CalibrationPhoto> photos = sound;
    for (CalibrationPhoto& photo : photos) {
      for (MarkerDetection& marker : photo.markers) {
        if (random.Uniform(0.0, 1.0) > 0.1 * round) continue;
        marker.id = random.Index(16);
        marker.center_px = {random.Uniform(0.0, 2000.0), random.Uniform(0.0, 1333.0)};
        marker.ellipse.semi_minor_px *= random.Uniform(0.2, 1.0);
      }
    }
    const CalibrationResult result = CalibrateCamera(options, photos);
    EXPECT_FALSE(result.advice.empty());
    if (result.verdict != CalibrationVerdict::kGood) continue;
    EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.2) << round << TextOf(result);
  }
}

}  // namespace
}  // namespace plumb
