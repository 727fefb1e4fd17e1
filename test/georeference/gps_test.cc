// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/georeference/survey_scene.h"

namespace plumb {
namespace {

using test::FindFinding;
using testing::AllOf;
using testing::HasSubstr;

// The scene at Graz, with a survey in UTM and photos that know where they were taken.
class GpsTest : public testing::Test {
 protected:
  GpsTest() {
    Survey& survey = scene_.survey;
    survey.crs = "EPSG:32633";
    survey.heights = HeightReference::kEllipsoidal;
    for (SurveyTarget& target : survey.targets) {
      target.point_in_crs = frame_.ToCrs(target.point_in_crs);
    }
  }

  // Hovering at 0.3 m of noise, off by `bias` all the flight.
  void SetPositions(const Eigen::Vector3d& bias, Georeferencer* georeferencer) {
    test::Random random(5);
    for (std::size_t k = 0; k < scene_.cams_from_enu.size(); ++k) {
      const double dx = random.Normal(0.3);
      const double dy = random.Normal(0.3);
      const Eigen::Vector3d noise(dx, dy, random.Normal(0.6));
      const auto place =
          frame_.ToWgs84(scene_.cams_from_enu[k].TargetOriginInSource() + bias + noise);
      georeferencer->SetPosition({static_cast<std::uint32_t>(k)}, *place);
    }
  }

  Georeference Run(const Eigen::Vector3d& bias = {1.0, -0.5, 2.0}) {
    Georeferencer georeferencer = test::MakeGeoreferencer(scene_);
    SetPositions(bias, &georeferencer);
    return georeferencer.Update();
  }

  GeoFrame frame_{"EPSG:32633", HeightReference::kEllipsoidal, {532600.0, 5212300.0, 360.0}};
  test::SurveyScene scene_ = test::MakeSurveyScene();
};

TEST_F(GpsTest, TargetsWinAndTheDifferenceIsReported) {
  const Georeference georeference = Run();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  ASSERT_TRUE(georeference.gps);
  EXPECT_EQ(georeference.gps->num_photos, 36);
  EXPECT_NEAR(*georeference.gps->scale_ratio, 1.0, 0.02);
  ASSERT_TRUE(georeference.gps->offset_m);
  // Median of 36: a fifth of the noise.
  EXPECT_LT((*georeference.gps->offset_m - Eigen::Vector3d(-1.0, 0.5, -2.0)).norm(), 0.4);
  EXPECT_TRUE(georeference.findings.empty()) << georeference.findings[0].text;
  // The frame is this test's but for the origin, and its plane turns by as much over the earth.
  ASSERT_TRUE(georeference.earth_from_map);
  const Eigen::Vector3d point_in_map(1.0, 2.0, 3.0);
  const Eigen::Vector3d in_earth =
      *frame_.EarthFromEnu() * (scene_.map_from_enu.Inverse() * point_in_map);
  EXPECT_LT((*georeference.earth_from_map * point_in_map - in_earth).norm(), 0.005);
}

TEST_F(GpsTest, AloneItIsCoarse) {
  Georeferencer georeferencer({}, scene_.camera);
  georeferencer.Apply(scene_.map);
  SetPositions({1.0, -0.5, 2.0}, &georeferencer);
  const Georeference georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kGps);
  EXPECT_NE(FindFinding(georeference, "gps_only"), nullptr);
  EXPECT_EQ(georeference.frame->crs(), "EPSG:4979");
  EXPECT_NEAR(georeference.enu_from_map.scale * scene_.map_from_enu.scale, 1.0, 0.03);
  const auto place =
      georeference.frame->ToWgs84(georeference.enu_from_map * Eigen::Vector3d(3, -5, 2));
  const auto truth = frame_.ToWgs84({0, 0, 0});
  EXPECT_NEAR(place->lat_deg, truth->lat_deg, 3.0 / 111'000.0);
  EXPECT_NEAR(*place->alt_m, *truth->alt_m, 5.0);
}

TEST_F(GpsTest, LeavesPhotosOutThatAreFarOff) {
  Georeferencer georeferencer({}, scene_.camera);
  georeferencer.Apply(scene_.map);
  SetPositions({0, 0, 0}, &georeferencer);
  for (std::uint32_t k = 0; k < 10; ++k) {
    georeferencer.SetPosition({3 * k}, *frame_.ToWgs84({500.0 + 40.0 * k, 300.0, 0.0}));
  }
  const Georeference georeference = georeferencer.Update();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kGps);
  EXPECT_NEAR(georeference.enu_from_map.scale * scene_.map_from_enu.scale, 1.0, 0.04);
}

TEST_F(GpsTest, NeedsHeightsAndMoreThanALine) {
  Georeferencer georeferencer({}, scene_.camera);
  georeferencer.Apply(scene_.map);
  for (std::uint32_t k = 0; k < 36; ++k) georeferencer.SetPosition({k}, {47.0, 15.0, std::nullopt});
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kNone);
  EXPECT_FALSE(georeferencer.Update().gps);
}

TEST_F(GpsTest, NoticesOtherUnitsByTheScale) {
  const std::vector<SurveyTarget> in_metres = scene_.survey.targets;
  const std::map<std::string, double> per_metre_of_unit = {
      {"feet", 1.0 / 0.3048}, {"millimetres", 1000.0}, {"kilometres", 0.001}};
  for (const auto& [name, per_metre] : per_metre_of_unit) {
    SCOPED_TRACE(name);
    scene_.survey.targets = in_metres;
    const Eigen::Vector3d origin = in_metres[0].point_in_crs;
    for (SurveyTarget& target : scene_.survey.targets) {
      target.point_in_crs = origin + (target.point_in_crs - origin) * per_metre;
    }
    const Georeference georeference = Run();
    EXPECT_EQ(georeference.source, GeoreferenceSource::kGps);  // What there is beside.
    const Finding* unit = FindFinding(georeference, "unit");
    ASSERT_NE(unit, nullptr);
    EXPECT_EQ(unit->severity, Finding::Severity::kError);
    EXPECT_THAT(unit->text,
                AllOf(HasSubstr("times as large as by the photos' GPS"), HasSubstr(name)));
  }
}

TEST_F(GpsTest, NoticesAnotherWrongScale) {
  const Eigen::Vector3d origin = scene_.survey.targets[0].point_in_crs;
  for (SurveyTarget& target : scene_.survey.targets) {
    target.point_in_crs = origin + (target.point_in_crs - origin) * 1.5;
  }
  EXPECT_NE(FindFinding(Run(), "implausible_scale"), nullptr);
}

TEST_F(GpsTest, SaysWhenGpsIsElsewhere) {
  const Georeference georeference = Run({30.0, 0.0, 47.0});
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  const Finding* elsewhere = FindFinding(georeference, "gps_disagrees");
  ASSERT_NE(elsewhere, nullptr);
  EXPECT_THAT(elsewhere->text, AllOf(HasSubstr("the targets are taken"), HasSubstr("CRS")));
  const Finding* height = FindFinding(georeference, "gps_height_disagrees");
  ASSERT_NE(height, nullptr);
  EXPECT_THAT(height->text, HasSubstr("taken as ellipsoidal"));
}

TEST_F(GpsTest, NoticesExchangedAxesInsideTheAreaOfTheCrs) {
  // A plane's mirror image fits, and a grid with small numbers holds both places.
  scene_.survey.crs = "EPSG:27700";
  const GeoFrame british("EPSG:27700", HeightReference::kEllipsoidal, {300000.0, 400000.0, 50.0});
  frame_ = british;
  const test::SurveyScene local = test::MakeSurveyScene();
  for (std::size_t i = 0; i < local.survey.targets.size(); ++i) {
    Eigen::Vector3d point = british.ToCrs(local.survey.targets[i].point_in_crs);
    std::swap(point.x(), point.y());
    scene_.survey.targets[i].point_in_crs = point;
  }
  const Georeference georeference = Run();
  const Finding* swapped = FindFinding(georeference, "swapped_axes");
  ASSERT_NE(swapped, nullptr);
  EXPECT_NE(georeference.source, GeoreferenceSource::kTargets);
}

TEST_F(GpsTest, RefusesASurveyInAnotherUtmZone) {
  scene_.survey.crs = "EPSG:32632";  // Six degrees to the west, inside that zone's area.
  Georeferencer georeferencer = test::MakeGeoreferencer(scene_);
  EXPECT_EQ(georeferencer.Update().source, GeoreferenceSource::kTargets);  // Nothing disputes it.
  SetPositions({1.0, -0.5, 2.0}, &georeferencer);
  const Georeference& georeference = georeferencer.Update();
  const Finding* elsewhere = FindFinding(georeference, "survey_elsewhere");
  ASSERT_NE(elsewhere, nullptr);
  EXPECT_EQ(elsewhere->severity, Finding::Severity::kError);
  EXPECT_THAT(elsewhere->text,
              AllOf(HasSubstr("survey.csv: lies 45"),
                    HasSubstr("km from where the photos' GPS is"),
                    HasSubstr("as EPSG:32633: give that CRS instead of \"EPSG:32632\"")));
  EXPECT_EQ(FindFinding(georeference, "gps_disagrees"), nullptr);  // Said already.
  // What there is beside, in a frame of its own.
  EXPECT_EQ(georeference.source, GeoreferenceSource::kGps);
  EXPECT_EQ(georeference.frame->crs(), "EPSG:4979");
  EXPECT_LT(georeference.enu_from_map.translation.norm(), 500.0);
  for (const MarkerTrack& marker : georeferencer.Constraints().markers) {
    EXPECT_FALSE(marker.survey);
  }
}

TEST_F(GpsTest, RefusesASurveyOfAnotherSiteBeforeAMarkerIsSeen) {
  Survey elsewhere = scene_.survey;
  for (SurveyTarget& target : elsewhere.targets) target.point_in_crs.x() += 1200.0;
  Georeferencer georeferencer({}, scene_.camera);
  const auto problem = [&](const Survey& survey) {
    return georeferencer.FindElsewhere(survey, GeoFrame::Around(survey));
  };
  EXPECT_FALSE(problem(elsewhere));  // No photo yet.
  SetPositions({0.0, 0.0, 0.0}, &georeferencer);
  EXPECT_FALSE(problem(scene_.survey));
  const auto found = problem(elsewhere);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->text,
              AllOf(HasSubstr("lies 1.19"),
                    HasSubstr("instead of \"EPSG:32633\""),
                    HasSubstr("survey of this site"),
                    HasSubstr("max_gps_distance_m")));
  // A few photos without a fix and a mistyped target decide nothing.
  for (std::uint32_t k = 0; k < 10; ++k) georeferencer.SetPosition({k}, {0.0, 0.0, 0.0});
  Survey mistyped = scene_.survey;
  mistyped.targets[3].point_in_crs.y() += 500'000.0;
  EXPECT_FALSE(problem(mistyped));

  GeoreferencerOptions options;
  options.max_gps_distance_m = 2000.0;
  Georeferencer trusting(options, scene_.camera);
  SetPositions({0.0, 0.0, 0.0}, &trusting);
  EXPECT_FALSE(trusting.FindElsewhere(elsewhere, GeoFrame::Around(elsewhere)));
}

TEST_F(GpsTest, KnowsThePlaceOfASouthernZoneAndOfTheOtherSideOfTheEarth) {
  Georeferencer georeferencer({}, scene_.camera);
  Survey survey;
  survey.source = "survey.csv";
  survey.crs = "EPSG:32633";
  survey.heights = HeightReference::kEllipsoidal;
  survey.targets.resize(1);
  survey.targets[0].point_in_crs = {334000.0, 6252000.0, 20.0};
  georeferencer.SetPosition({0}, {-33.8588, 151.2053, 20.0});  // Sydney, zone 56 south.
  const auto southern = georeferencer.FindElsewhere(survey, GeoFrame::Around(survey));
  ASSERT_TRUE(southern);
  EXPECT_THAT(southern->text, HasSubstr("as EPSG:32756"));
  georeferencer.SetPosition({0}, {-56.4, -167.7, 20.0});  // About opposite to the survey.
  const auto opposite = georeferencer.FindElsewhere(survey, GeoFrame::Around(survey));
  ASSERT_TRUE(opposite);
  EXPECT_THAT(opposite->text, HasSubstr("lies 20013."));
}

TEST_F(GpsTest, ALocalSurveyIsHeldAgainstTheScaleOnly) {
  scene_.survey = test::MakeSurveyScene().survey;
  const Georeference georeference = Run();
  EXPECT_EQ(georeference.source, GeoreferenceSource::kTargets);
  ASSERT_TRUE(georeference.gps);
  EXPECT_NEAR(*georeference.gps->scale_ratio, 1.0, 0.02);
  EXPECT_FALSE(georeference.gps->offset_m);
}

TEST_F(GpsTest, GoesIntoTheBundleOnlyIfAsked) {
  Georeferencer without = test::MakeGeoreferencer(scene_);
  SetPositions({1.0, -0.5, 2.0}, &without);
  without.Update();
  EXPECT_TRUE(without.Constraints().centers.empty());

  GeoreferencerOptions options;
  options.gps_in_bundle = true;
  Georeferencer georeferencer(options, scene_.camera);
  georeferencer.Apply(scene_.map);
  SetPositions({40.0, -30.0, 20.0}, &georeferencer);  // What all are off by is not disputed.
  georeferencer.Update();
  const BundleConstraints constraints = georeferencer.Constraints();
  ASSERT_EQ(constraints.centers.size(), 36U);
  for (const CenterPrior& prior : constraints.centers) {
    EXPECT_NEAR(prior.center.sigma / scene_.map_from_enu.scale, 2.0, 0.1);
    const ViewState& view = scene_.map.views_set[prior.photo.value];
    const double off_m =
        (prior.center.position_in_map - view.cam_from_map.TargetOriginInSource()).norm() /
        scene_.map_from_enu.scale;
    EXPECT_LT(off_m, 3.0);  // Its noise.
  }
}

}  // namespace
}  // namespace plumb
