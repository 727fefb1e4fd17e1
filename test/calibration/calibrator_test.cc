// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibrator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/lens_accuracy.h"
#include "plumbline/marker/marker_sheet.h"
#include "test/calibration/calibration_checks.h"

namespace plumb {
namespace {

using test::CalibrationSceneOptions;
using test::FindingOf;
using test::FocalErrorPercent;
using test::Kind;
using test::MakeCalibrationPhotos;
using test::PrincipalErrorPx;
using test::QuickOptions;
using test::TextOf;

double DistortionErrorPx(const CalibrationResult& result, const Camera& truth) {
  return DistortionDifference(
      truth.width_px(), truth.height_px(), truth.lens(), result.estimate->camera.lens());
}

std::vector<test::ScenePlate> GridPlates(double stretch = 1.0) {
  const MarkerSheet sheet = LayOutGrid(Paper::kA4, Arrangement::kFixed, 0);
  std::vector<test::ScenePlate> plates;
  for (const PrintedMarker& marker : sheet.markers) {
    const Eigen::Vector2d center = (marker.center_mm - 0.5 * sheet.page_mm) / sheet.diameter_mm;
    plates.push_back({marker.id, {center.x(), -stretch * center.y(), 0.0}, 0.0});
  }
  return plates;
}

CalibrationOptions GridOptions() {
  CalibrationOptions options = QuickOptions();
  options.fixed_grid = "a4";
  return options;
}

TEST(CalibrateCamera, IsExactWithoutNoise) {
  CalibrationSceneOptions scene;
  scene.noise_factor = 0.0;
  const CalibrationResult result = CalibrateCamera(QuickOptions(), MakeCalibrationPhotos(scene));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 1e-3);
  EXPECT_LT(PrincipalErrorPx(result, scene.camera), 0.02);
  EXPECT_LT(DistortionErrorPx(result, scene.camera), 0.01);
  EXPECT_LT(result.rms_px, 0.002);
}

TEST(CalibrateCamera, IsGoodAfterTwelvePhotosAllAround) {
  const CalibrationSceneOptions scene;
  const CalibrationResult result = CalibrateCamera({}, MakeCalibrationPhotos(scene), "nex");
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_EQ(result.verdict, CalibrationVerdict::kGood) << TextOf(result);
  EXPECT_EQ(result.estimate->camera.name(), "nex");
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.05);
  EXPECT_LT(PrincipalErrorPx(result, scene.camera), 1.0);
  EXPECT_LT(DistortionErrorPx(result, scene.camera), 0.1);
  EXPECT_TRUE(result.findings.empty()) << TextOf(result);
  EXPECT_EQ(result.focal_search.error.size(), 48U);
  EXPECT_NEAR(result.focal_search.best_focal_px, 1360.0, 80.0);
}

TEST(CalibrateCamera, FindsWideAndLongLensesInTheWholeRange) {
  for (const double per_width : {0.4, 1.5, 4.0}) {
    SCOPED_TRACE(per_width);
    LensParameters<double> lens = test::CalibrationLens();
    lens[kFx] = lens[kFy] = per_width * 2000.0;
    if (per_width < 0.5) lens[kK1] = -0.12;
    CalibrationSceneOptions scene;
    scene.camera = test::CalibrationCamera(lens);
    CalibrationOptions options;
    options.num_focal_steps = 24;
    const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos(scene));
    ASSERT_TRUE(result.estimate) << TextOf(result);
    EXPECT_LT(FocalErrorPercent(result, scene.camera),
              4.0 * result.estimate->focal_sigma_percent + 0.01);
    EXPECT_LT(DistortionErrorPx(result, scene.camera),
              3.0 * result.estimate->distortion_sigma_px + 0.01);
  }
}

// The law that everything else rests on: errors are as large as their standard deviations say.
TEST(CalibrateCamera, ItsStandardDeviationsAreHonest) {
  double focal = 0.0;
  double principal = 0.0;
  double distortion = 0.0;
  constexpr int kNumSets = 12;
  for (int seed = 1; seed <= kNumSets; ++seed) {
    CalibrationSceneOptions scene;
    scene.random_seed = seed;
    CalibrationOptions options = QuickOptions();
    options.num_focal_steps = 8;
    options.min_focal_per_width = 0.6;
    options.max_focal_per_width = 0.8;
    const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos(scene));
    ASSERT_TRUE(result.estimate) << TextOf(result);
    const LensEstimate& estimate = *result.estimate;
    const auto sigmas = [&](int k) {
      const auto idx = static_cast<std::size_t>(k);
      return (estimate.camera.lens()[idx] - scene.camera.lens()[idx]) / estimate.sigma[idx];
    };
    focal += std::pow(sigmas(kFx), 2) / kNumSets;
    principal += 0.5 * (std::pow(sigmas(kCx), 2) + std::pow(sigmas(kCy), 2)) / kNumSets;
    distortion +=
        std::pow(DistortionErrorPx(result, scene.camera) / estimate.distortion_sigma_px, 2) /
        kNumSets;
  }
  // Mean squares of 12 to 60 standard normal values.
  EXPECT_GT(focal, 0.3);
  EXPECT_LT(focal, 2.4);
  EXPECT_GT(principal, 0.4);
  EXPECT_LT(principal, 2.0);
  EXPECT_GT(distortion, 0.3);
  EXPECT_LT(distortion, 2.4);
}

TEST(CalibrateCamera, GivesTheSameTwice) {
  const std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos();
  const CalibrationResult first = CalibrateCamera(QuickOptions(), photos);
  const CalibrationResult second = CalibrateCamera(QuickOptions(), photos);
  ASSERT_TRUE(first.estimate && second.estimate);
  EXPECT_EQ(first.estimate->camera.lens(), second.estimate->camera.lens());
  EXPECT_EQ(first.advice, second.advice);
}

TEST(CalibrateCamera, TellsPosesAndMarkersInMetres) {
  CalibrationSceneOptions scene;
  CalibrationOptions options = QuickOptions();
  options.marker_diameter_m = 0.1;
  const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos(scene));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_TRUE(result.is_metric);
  test::Random random(1000 + scene.random_seed);
  const std::vector<test::ScenePlate> plates = test::StrewnPlates(&random);
  // Shapes give the scale: to a percent.
  for (std::size_t i = 1; i < plates.size(); ++i) {
    const double distance =
        (result.markers[i].center_in_plane - result.markers[0].center_in_plane).norm();
    const double truth = 0.1 * (plates[i].center - plates[0].center).norm();
    EXPECT_NEAR(distance, truth, 0.01 * truth);
    const double turn = result.markers[i].angle_rad - result.markers[0].angle_rad -
                        (plates[i].angle_rad - plates[0].angle_rad);
    EXPECT_NEAR(std::remainder(turn, 2.0 * M_PI), 0.0, 0.03);
    EXPECT_GT(result.photos[0].cam_from_plane.TargetOriginInSource().z(), 0.0);
  }
}

// By 3 mm and by 2 mm, on markers of 32 mm.
TEST(CalibrateCamera, AllowsForABentSheetAndNamesAllOfIt) {
  for (const double bend : {0.094, 0.0625}) {
    SCOPED_TRACE(bend);
    std::vector<test::ScenePlate> plates = GridPlates();
    for (test::ScenePlate& plate : plates) {
      plate.center.z() = bend * (1.0 - std::pow(plate.center.x() / 2.1, 2));
    }
    const CalibrationSceneOptions scene;
    const CalibrationResult result =
        CalibrateCamera(GridOptions(), test::PhotographPlates(scene, plates));
    ASSERT_TRUE(result.estimate) << TextOf(result);
    EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.2);
    const auto finding = FindingOf(result, Kind::kOffPlane);
    ASSERT_TRUE(finding) << TextOf(result);
    EXPECT_THAT(finding->text, testing::HasSubstr("bent"));
    EXPECT_EQ(finding->marker_ids.size(), plates.size()) << TextOf(result);
  }
}

TEST(CalibrateCamera, AllowsForAPrinterThatStretches) {
  const CalibrationSceneOptions scene;
  const CalibrationResult result =
      CalibrateCamera(GridOptions(), test::PhotographPlates(scene, GridPlates(1.004)));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.1);
  const auto finding = FindingOf(result, Kind::kStretched);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->text, testing::HasSubstr("0.4"));
}

TEST(CalibrateCamera, DoesWithTwoThirdsOfTheMarkers) {
  CalibrationSceneOptions scene;
  scene.hidden_share = 0.33;
  const CalibrationResult result = CalibrateCamera(QuickOptions(), MakeCalibrationPhotos(scene));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_LT(FocalErrorPercent(result, scene.camera), 0.2);
  const auto finding = FindingOf(result, Kind::kWrongView);
  ASSERT_TRUE(finding) << TextOf(result);
  EXPECT_THAT(finding->text, testing::HasSubstr("were not found"));
  EXPECT_GE(finding->photos.size(), 8U);
}

TEST(CalibrateCamera, FitsARationalLens) {
  LensParameters<double> lens = test::CalibrationLens();
  lens[kFx] = lens[kFy] = 1300.0;
  lens[kK1] = 0.1;
  lens[kK2] = 0.02;
  lens[kK4] = 0.25;
  lens[kK5] = 0.05;
  CalibrationSceneOptions scene;
  scene.camera = test::CalibrationCamera(lens);
  CalibrationOptions options = QuickOptions();
  options.rational = true;
  const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos(scene));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  EXPECT_EQ(result.estimate->camera.model(), DistortionModel::kRationalPolynomial);
  EXPECT_LT(DistortionErrorPx(result, scene.camera),
            3.0 * result.estimate->distortion_sigma_px + 0.01);
}

TEST(CalibrateCamera, EstimatesBothFocalLengthsWhereAsked) {
  LensParameters<double> lens = test::CalibrationLens();
  lens[kFy] *= 1.01;
  CalibrationSceneOptions scene;
  scene.camera = test::CalibrationCamera(lens);
  CalibrationOptions options = QuickOptions();
  options.square_pixels = false;
  const CalibrationResult result = CalibrateCamera(options, MakeCalibrationPhotos(scene));
  ASSERT_TRUE(result.estimate) << TextOf(result);
  const LensEstimate& estimate = *result.estimate;
  EXPECT_NEAR(estimate.camera.lens()[kFy], lens[kFy], 4.0 * estimate.sigma[kFy]);
  EXPECT_GT(estimate.sigma[kFy], 0.0);
}

TEST(CalibrateCamera, RefusesOptionsThatMakeNoSense) {
  CalibrationOptions options;
  options.fixed_grid = "a5";
  options.min_focal_per_width = 6.0;
  EXPECT_EQ(options.Problems().size(), 2U);
  EXPECT_THROW(CalibrateCamera(options, {}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
