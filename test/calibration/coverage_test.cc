// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "calibration/view_slant.h"
#include "plumbline/calibration/calibration_coverage.h"
#include "test/support/calibration_scene.h"

namespace plumb {
namespace {

CalibrationPhoto Photo(const Rigid3& cam_from_plane, const std::string& name) {
  test::Random plates_random(3);
  test::Random random(1);
  test::CalibrationSceneOptions scene;
  scene.noise_factor = 0.0;
  return SeePlates(scene, test::StrewnPlates(&plates_random), cam_from_plane, name, &random);
}

// From a distance, turned by quarters, and tilted about an axis in the image.
Rigid3 Pose(double distance, int quarter, double tilt_rad, double axis_rad) {
  return {Eigen::AngleAxisd(0.5 * M_PI * quarter, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(tilt_rad,
                                Eigen::Vector3d(std::cos(axis_rad), std::sin(axis_rad), 0.0)) *
              Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0),
          {0.0, 0.0, distance}};
}

std::vector<int> Counts(const std::vector<CoverageBar>& bars) {
  std::vector<int> counts;
  for (const CoverageBar& bar : bars) counts.push_back(bar.count);
  return counts;
}

TEST(MeasureCoverage, IsEmptyWithoutPhotos) {
  const CalibrationCoverage coverage = MeasureCoverage({});
  EXPECT_EQ(coverage.num_photos, 0);
  EXPECT_EQ(coverage.image_share, 0.0);
}

TEST(MeasureCoverage, CountsCentresByCell) {
  CalibrationPhoto photo = Photo(Pose(20.0, 0, 0.0, 0.0), "a");
  photo.markers.resize(1);
  photo.markers[0].center_px = {1999.4, -0.4};
  photo.markers[0].ellipse = {{1999.4, -0.4}, 10.0, 10.0, 0.0};
  const CalibrationCoverage coverage = MeasureCoverage({photo});
  EXPECT_EQ(coverage.num_cols, 12);
  EXPECT_EQ(coverage.num_rows, 8);
  EXPECT_EQ(coverage.CentersInCell(11, 0), 1);
  EXPECT_EQ(std::accumulate(coverage.centers_in_cell.begin(), coverage.centers_in_cell.end(), 0),
            1);
  EXPECT_NEAR(coverage.image_share, 1.0 / 96.0, 1e-9);
}

TEST(MeasureCoverage, TellsTiltDirectionTurnAndDistance) {
  // About the image's x axis by a positive angle the lower part of the image comes nearer.
  const std::vector<CalibrationPhoto> photos = {Photo(Pose(14.0, 0, 0.0, 0.0), "flat"),
                                                Photo(Pose(14.0, 1, 0.0, 0.0), "turned"),
                                                Photo(Pose(20.0, 0, 0.4, 0.0), "far, tilted"),
                                                Photo(Pose(16.0, 0, 0.6, 0.5 * M_PI), "side"),
                                                Photo(Pose(10.0, 2, 0.0, 0.0), "near")};
  const CalibrationCoverage coverage = MeasureCoverage(photos);
  EXPECT_EQ(coverage.num_photos, 5);
  EXPECT_THAT(Counts(coverage.tilt), testing::ElementsAre(3, 1, 1, 0));
  EXPECT_THAT(Counts(coverage.turn), testing::ElementsAre(4, 1));
  EXPECT_THAT(Counts(coverage.distance), testing::ElementsAre(1, 3, 1));
  EXPECT_NEAR(coverage.distance_ratio, 2.0, 0.15);
  // One tilt brings top or bottom nearer, the other left or right.
  const std::vector<int> direction = Counts(coverage.direction);
  EXPECT_EQ(direction[0] + direction[1], 1);
  EXPECT_EQ(direction[2] + direction[3], 1);
}

// The camera of the scene is of 0.68 widths; the guess is for 0.7.
TEST(MeasureCoverage, GuessesTiltsAwayFromTheMiddleOfTheImage) {
  std::vector<CalibrationPhoto> photos;
  for (const double tilt_deg : {5.0, 19.0, 27.0, 35.0, 42.0}) {
    Rigid3 cam_from_plane = Pose(14.0, 0, tilt_deg * M_PI / 180.0, 0.7);
    cam_from_plane.translation.x() += 3.0;
    cam_from_plane.translation.y() -= 2.0;
    photos.push_back(Photo(cam_from_plane, std::to_string(tilt_deg)));
  }
  EXPECT_THAT(Counts(MeasureCoverage(photos).tilt), testing::ElementsAre(1, 2, 2, 0));
}

TEST(MeasureCoverage, CountsTiltsInWholeDegreesOnce) {
  const auto slant = [](double tilt_deg) { return ViewSlant{tilt_deg, {1.0, 0.0}}; };
  CalibrationCoverage coverage;
  for (int i = 0; i < 2; ++i) {  // The second time in the place of the first.
    CountSlants({slant(14.4), slant(14.6), slant(29.4), slant(45.4), slant(45.6)}, &coverage);
    EXPECT_THAT(Counts(coverage.tilt), testing::ElementsAre(1, 2, 1, 1));
    EXPECT_THAT(Counts(coverage.direction), testing::ElementsAre(0, 4, 0, 0));
  }
}

TEST(MeasureCoverage, ACellWithACentreIsTouched) {
  const CalibrationCoverage coverage = MeasureCoverage({Photo(Pose(14.0, 0, 0.3, 0.0), "a")});
  int num_touched = 0;
  for (int row = 0; row < coverage.num_rows; ++row) {
    for (int col = 0; col < coverage.num_cols; ++col) {
      num_touched += coverage.IsCellTouched(col, row) ? 1 : 0;
      EXPECT_TRUE(coverage.CentersInCell(col, row) == 0 || coverage.IsCellTouched(col, row));
    }
  }
  EXPECT_NEAR(coverage.image_share,
              num_touched / static_cast<double>(coverage.num_cols * coverage.num_rows),
              1e-9);
}

// The nearer side is the one whose markers are larger.
TEST(MeasureCoverage, TheNearSideHasTheLargerMarkers) {
  const CalibrationPhoto photo = Photo(Pose(14.0, 0, 0.6, 0.0), "tilted");
  const auto [top, bottom] = std::minmax_element(
      photo.markers.begin(), photo.markers.end(), [](const auto& a, const auto& b) {
        return a.center_px.y() < b.center_px.y();
      });
  const bool is_near_at_bottom = bottom->ellipse.semi_major_px > top->ellipse.semi_major_px;
  const CalibrationCoverage coverage = MeasureCoverage({photo});
  EXPECT_EQ(coverage.direction[is_near_at_bottom ? 3 : 2].count, 1);
}

}  // namespace
}  // namespace plumb
