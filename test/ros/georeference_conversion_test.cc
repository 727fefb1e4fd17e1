// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/georeference_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ros/constraints_conversion.h"
#include "ros/geometry_conversion.h"
#include "ros/position_conversion.h"
#include "test/georeference/survey_scene.h"

namespace plumb::ros_adapter {
namespace {

using test::SurveyScene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std_msgs::Header MapHeader() {
  std_msgs::Header header;
  header.frame_id = "map";
  return header;
}

template <typename Array>
Eigen::Vector3d ToVector(const Array& array) {
  return {array[0], array[1], array[2]};
}

class GeoreferenceMsgTest : public testing::Test {
 protected:
  plumbline::Georeference Message() {
    Georeferencer georeferencer = test::MakeGeoreferencer(scene_);
    return ToGeoreferenceMsg(georeferencer.Update(), &scene_.survey, MapHeader());
  }

  SurveyScene scene_ = test::MakeSurveyScene();
};

TEST_F(GeoreferenceMsgTest, TakesPointsOfTheMapIntoEnu) {
  const plumbline::Georeference msg = Message();
  EXPECT_EQ(msg.source, plumbline::Georeference::TARGETS);
  EXPECT_FALSE(msg.is_coarse);
  EXPECT_EQ(msg.map_sequence, scene_.map.sequence);
  EXPECT_EQ(msg.crs, "local");
  EXPECT_FALSE(msg.is_on_earth);
  const auto enu_from_map = FromTransformMsg(msg.enu_from_map);
  ASSERT_TRUE(enu_from_map);
  for (const Eigen::Vector3d& in_enu : scene_.targets_in_enu) {
    const Eigen::Vector3d in_map = scene_.map_from_enu * in_enu;
    EXPECT_LT((*enu_from_map * (msg.metres_per_map_unit * in_map) - in_enu).norm(), 0.003);
  }
}

TEST_F(GeoreferenceMsgTest, ResidualIsModelLessSurveyInBothFrames) {
  const plumbline::Georeference msg = Message();
  const auto enu_from_map = FromTransformMsg(msg.enu_from_map);
  ASSERT_EQ(msg.targets.size(), 17U);
  for (const plumbline::TargetResidual& target : msg.targets) {
    EXPECT_EQ(target.state, plumbline::TargetResidual::GOOD);
    const Eigen::Vector3d in_map = ToVector(target.point_in_map) - ToVector(target.survey_in_map);
    const Eigen::Vector3d residual_mm =
        1000.0 * msg.metres_per_map_unit * (enu_from_map->rotation * in_map);
    EXPECT_LT((residual_mm - ToVector(target.residual_mm)).norm(), 1e-6);
    EXPECT_NEAR(target.error_mm, residual_mm.norm(), 1e-6);
    EXPECT_EQ(target.role == plumbline::TargetResidual::CHECK, target.id % 3 == 2);
  }
  EXPECT_EQ(msg.num_control, 12U);
  EXPECT_EQ(msg.num_check, 5U);
}

TEST_F(GeoreferenceMsgTest, WhatIsNotKnownIsNan) {
  scene_.markers.clear();
  const plumbline::Georeference msg = Message();
  EXPECT_EQ(msg.source, plumbline::Georeference::NONE);
  EXPECT_TRUE(msg.is_coarse);
  EXPECT_EQ(msg.metres_per_map_unit, 0.0);
  EXPECT_FALSE(FromTransformMsg(msg.enu_from_map));  // An identity would be a lie.
  EXPECT_TRUE(std::isnan(msg.gps_scale_ratio));
  ASSERT_EQ(msg.targets.size(), 17U);
  EXPECT_EQ(msg.targets[0].state, plumbline::TargetResidual::UNSEEN);
  for (const auto& array :
       {msg.targets[0].point_in_map, msg.targets[0].survey_in_map, msg.targets[0].residual_mm}) {
    EXPECT_TRUE(std::isnan(array[0]));
  }
  EXPECT_TRUE(std::isnan(msg.targets[0].error_mm));
  ASSERT_FALSE(msg.findings.empty());
  EXPECT_EQ(msg.findings[0].severity, plumbline::GeoreferenceFinding::ERROR);
  EXPECT_EQ(msg.findings[0].code, "too_few_targets");
}

TEST_F(GeoreferenceMsgTest, SaysWhereAnUnseenTargetHangs) {
  for (auto& [photo, markers] : scene_.markers) {
    markers.erase(std::remove_if(markers.begin(),
                                 markers.end(),
                                 [](const MarkerDetection& marker) { return marker.id == 4; }),
                  markers.end());
  }
  const plumbline::Georeference msg = Message();
  const plumbline::TargetResidual& unseen = msg.targets[4];
  EXPECT_EQ(unseen.state, plumbline::TargetResidual::UNSEEN);
  const Eigen::Vector3d truth = scene_.map_from_enu * scene_.targets_in_enu[4];
  EXPECT_LT((ToVector(unseen.survey_in_map) - truth).norm(), 0.003 * scene_.map_from_enu.scale);
}

TEST_F(GeoreferenceMsgTest, GivesThePlaceOnEarthInDouble) {
  scene_.survey.crs = "EPSG:31256";  // Austria, about Vienna.
  scene_.survey.heights = HeightReference::kEllipsoidal;
  for (SurveyTarget& target : scene_.survey.targets) {
    target.point_in_crs += Eigen::Vector3d(-68000.0, 212000.0, 360.0);
  }
  const plumbline::Georeference msg = Message();
  ASSERT_TRUE(msg.is_on_earth);
  const auto earth_from_enu = FromTransformMsg(msg.earth_from_enu);
  ASSERT_TRUE(earth_from_enu);
  EXPECT_NEAR(earth_from_enu->translation.norm(), 6.37e6, 2e4);
  EXPECT_LT(FromTransformMsg(msg.enu_from_map)->translation.norm(), 1000.0);
}

TEST(GeoreferenceMsg, ItsWordsAreThoseOfTheCore) {
  EXPECT_EQ(plumbline::Georeference::NONE, ToString(GeoreferenceSource::kNone));
  EXPECT_EQ(plumbline::Georeference::GPS, ToString(GeoreferenceSource::kGps));
  EXPECT_EQ(plumbline::Georeference::TARGETS, ToString(GeoreferenceSource::kTargets));
  EXPECT_EQ(plumbline::TargetResidual::UNSEEN, ToString(TargetState::kUnseen));
  EXPECT_EQ(plumbline::TargetResidual::DOUBLE, ToString(TargetState::kDouble));
  EXPECT_EQ(plumbline::TargetResidual::UNSURVEYED, ToString(TargetState::kUnsurveyed));
  EXPECT_EQ(plumbline::TargetResidual::WAITING, ToString(TargetState::kWaiting));
  EXPECT_EQ(plumbline::TargetResidual::GOOD, ToString(TargetState::kGood));
  EXPECT_EQ(plumbline::TargetResidual::WRONG, ToString(TargetState::kWrong));
  EXPECT_EQ(plumbline::GeoreferenceFinding::NOTE, ToString(Finding::Severity::kNote));
  EXPECT_EQ(plumbline::GeoreferenceFinding::WARNING, ToString(Finding::Severity::kWarning));
  EXPECT_EQ(plumbline::GeoreferenceFinding::ERROR, ToString(Finding::Severity::kError));
}

BundleConstraints MakeConstraints() {
  SurveyScene scene = test::MakeSurveyScene();
  Georeferencer georeferencer = test::MakeGeoreferencer(scene);
  georeferencer.Update();
  return georeferencer.Constraints();
}

TEST(ControlPointsMsg, RoundTripKeepsAllToTheLastBit) {
  const BundleConstraints constraints = MakeConstraints();
  const auto back = FromControlPointsMsg(ToControlPointsMsg(constraints, 7, MapHeader()));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->markers.size(), constraints.markers.size());
  for (std::size_t i = 0; i < back->markers.size(); ++i) {
    const MarkerTrack& track = back->markers[i];
    const MarkerTrack& truth = constraints.markers[i];
    EXPECT_EQ(track.marker_id, truth.marker_id);
    EXPECT_EQ(track.position_in_map, truth.position_in_map);
    ASSERT_EQ(track.survey.has_value(), truth.survey.has_value());
    if (truth.survey) {
      EXPECT_EQ(track.survey->position_in_map, truth.survey->position_in_map);
      EXPECT_EQ(track.survey->sigma, truth.survey->sigma);
    }
    ASSERT_EQ(track.sightings.size(), truth.sightings.size());
    EXPECT_EQ(track.sightings[1].photo, truth.sightings[1].photo);
    EXPECT_EQ(track.sightings[1].center_px, truth.sightings[1].center_px);
    EXPECT_EQ(track.sightings[1].sigma_px, truth.sightings[1].sigma_px);
  }
}

TEST(ControlPointsMsg, RefusesWhatMakesNoSense) {
  const plumbline::ControlPoints sound = ToControlPointsMsg(MakeConstraints(), 7, MapHeader());
  const auto refuses = [&](const std::function<void(plumbline::ControlPoint&)>& spoil) {
    plumbline::ControlPoints msg = sound;
    spoil(msg.points[0]);
    return !FromControlPointsMsg(msg);
  };
  ASSERT_TRUE(sound.points[0].is_surveyed);
  EXPECT_TRUE(refuses([](auto& point) { point.position_in_map[1] = kNan; }));
  EXPECT_TRUE(refuses([](auto& point) { point.survey_in_map[2] = HUGE_VAL; }));
  EXPECT_TRUE(refuses([](auto& point) { point.survey_sigma = 0.0; }));
  EXPECT_TRUE(refuses([](auto& point) { point.photos.pop_back(); }));
  EXPECT_TRUE(refuses([](auto& point) { point.sigmas_px.push_back(0.1); }));
  EXPECT_TRUE(refuses([](auto& point) { point.sigmas_px[0] = -0.1; }));
  EXPECT_TRUE(refuses([](auto& point) { point.centers_px[3] = kNan; }));
  EXPECT_TRUE(refuses([](auto& point) { point.photos[1] = point.photos[0]; }));
  EXPECT_TRUE(refuses([](auto& point) { point.photos[0] = PhotoId::kInvalid; }));
  EXPECT_TRUE(refuses([&](auto& point) { point.marker_id = sound.points[1].marker_id; }));
  EXPECT_FALSE(refuses([](auto&) {}));
}

PhotoPositions MakePositions() {
  PhotoPositions positions;
  positions.camera = test::MakeCamera(-0.05);
  positions.position_of_photo[PhotoId{1}] = {48.2, 16.4, 200.5};
  positions.position_of_photo[PhotoId{7}] = {-48.2, -16.4, std::nullopt};
  return positions;
}

TEST(PhotoPositionsMsg, RoundTripKeepsAll) {
  const auto back = FromPhotoPositionsMsg(ToPhotoPositionsMsg(MakePositions(), MapHeader()));
  ASSERT_TRUE(back && back->camera);
  EXPECT_EQ(back->camera->lens(), MakePositions().camera->lens());
  ASSERT_EQ(back->position_of_photo.size(), 2U);
  EXPECT_EQ(back->position_of_photo.at(PhotoId{1}).alt_m, 200.5);
  EXPECT_EQ(back->position_of_photo.at(PhotoId{7}).lat_deg, -48.2);
  EXPECT_FALSE(back->position_of_photo.at(PhotoId{7}).alt_m);
}

TEST(PhotoPositionsMsg, IsReadWithoutACamera) {
  PhotoPositions positions = MakePositions();
  positions.camera.reset();
  const auto back = FromPhotoPositionsMsg(ToPhotoPositionsMsg(positions, MapHeader()));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->camera);
}

TEST(PhotoPositionsMsg, LeavesOutWhatIsNowhere) {
  plumbline::PhotoPositions msg = ToPhotoPositionsMsg(MakePositions(), MapHeader());
  msg.alts_ellipsoid_m[0] = 1e300;
  msg.lats_deg[1] = kNan;
  const auto back = FromPhotoPositionsMsg(msg);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->position_of_photo.size(), 1U);
  EXPECT_FALSE(back->position_of_photo.at(PhotoId{1}).alt_m);
}

TEST(PhotoPositionsMsg, RefusesArraysOfDifferentLengthAndNonsenseOfACamera) {
  plumbline::PhotoPositions msg = ToPhotoPositionsMsg(MakePositions(), MapHeader());
  msg.lons_deg.pop_back();
  EXPECT_FALSE(FromPhotoPositionsMsg(msg));
  msg = ToPhotoPositionsMsg(MakePositions(), MapHeader());
  msg.camera_info.K[0] = kNan;
  EXPECT_FALSE(FromPhotoPositionsMsg(msg));
}

}  // namespace
}  // namespace plumb::ros_adapter
