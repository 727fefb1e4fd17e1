// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "ros/camera_conversion.h"
#include "ros/geometry_conversion.h"
#include "ros/map_conversion.h"
#include "ros/marker_conversion.h"
#include "ros/photo_conversion.h"
#include "ros/verdict_conversion.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Rigid3 MakePose() { return {Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), {1e3, -2.0, 0.25}}; }

Camera MakeCamera(DistortionModel model) {
  LensParameters<double> lens{};
  lens[kFx] = 1200.25;
  lens[kFy] = 1199.75;
  lens[kCx] = 640.5;
  lens[kCy] = 360.5;
  lens[kK1] = -0.05;
  lens[kK2] = 0.01;
  lens[kP1] = 1e-4;
  lens[kP2] = -2e-4;
  lens[kK3] = -0.002;
  if (model == DistortionModel::kRationalPolynomial) lens[kK4] = 0.003;
  return Camera("camera", 1280, 720, model, lens);
}

MapDelta MakeDelta() {
  MapDelta delta;
  delta.sequence = 12;
  delta.lens = MakeCamera(DistortionModel::kPlumbBob).lens();
  delta.observations_removed = {{LandmarkId{3}, PhotoId{1}, 9, {0.0F, 0.0F}}};
  delta.landmarks_removed = {LandmarkId{3}, LandmarkId{8}};
  delta.views_removed = {PhotoId{2}};
  delta.views_set = {{PhotoId{1}, "a b.jpg", Timestamp{1'234'567'890'123'456'789}, MakePose()}};
  delta.landmarks_set = {{LandmarkId{5}, {1.0 / 3.0, 1e9, -0.0}, {1, 2, 255}}};
  delta.observations_added = {{LandmarkId{5}, PhotoId{1}, 4999, {3071.25F, -0.5F}}};
  return delta;
}

plumbline::MapDelta MakeDeltaMsg() { return ToMapDeltaMsg(MakeDelta(), "map", ros::Time(1, 2)); }

TEST(RosTime, KeepsEachNanosecond) {  // Law: round trip.
  for (const std::int64_t ns : {0L, 1L, 999'999'999L, 1'000'000'000L, 4'294'967'295'999'999'999L}) {
    ASSERT_TRUE(FitsRosTime({ns}));
    EXPECT_EQ(FromRosTime(ToRosTime({ns})), Timestamp{ns});
  }
}

TEST(RosTime, DoesNotFitBefore1970AndAfter2106) {
  EXPECT_FALSE(FitsRosTime({-1}));
  EXPECT_FALSE(FitsRosTime({4'294'967'296'000'000'000}));
  EXPECT_THROW(ToRosTime({-1}), std::logic_error);
}

TEST(TransformMsg, RoundTripKeepsThePose) {
  const auto back = FromTransformMsg(ToTransformMsg(MakePose()));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->rotation.isApprox(MakePose().rotation, 1e-15));
  EXPECT_EQ(back->translation, MakePose().translation);
}

TEST(TransformMsg, RefusesADefaultMessageRatherThanReadIdentity) {
  EXPECT_FALSE(FromTransformMsg(geometry_msgs::Transform()));
}

TEST(TransformMsg, RefusesNanAndNonUnitQuaternions) {
  geometry_msgs::Transform msg = ToTransformMsg(MakePose());
  msg.translation.y = kNan;
  EXPECT_FALSE(FromTransformMsg(msg));
  msg = ToTransformMsg(MakePose());
  msg.rotation.w = kNan;
  EXPECT_FALSE(FromTransformMsg(msg));
  msg = ToTransformMsg(MakePose());
  msg.rotation.w *= 1.1;
  EXPECT_FALSE(FromTransformMsg(msg));
}

TEST(VerdictMsg, ItsWordsAreThoseOfTheCore) {
  EXPECT_EQ(plumbline::PhotoVerdict::ACCEPTED, ToString(VerdictStatus::kAccepted));
  EXPECT_EQ(plumbline::PhotoVerdict::WAITING, ToString(VerdictStatus::kWaiting));
  EXPECT_EQ(plumbline::PhotoVerdict::REFUSED, ToString(VerdictStatus::kRefused));
}

TEST(MapDeltaMsg, RoundTripKeepsAllToTheLastBit) {
  const MapDelta delta = MakeDelta();
  const auto back = FromMapDeltaMsg(MakeDeltaMsg());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->sequence, delta.sequence);
  EXPECT_FALSE(back->is_snapshot);
  EXPECT_EQ(back->lens, delta.lens);
  ASSERT_EQ(back->observations_removed.size(), 1U);
  EXPECT_EQ(back->observations_removed[0].feature_idx, 9U);
  EXPECT_EQ(back->landmarks_removed, delta.landmarks_removed);
  EXPECT_EQ(back->views_removed, delta.views_removed);
  ASSERT_EQ(back->views_set.size(), 1U);
  EXPECT_EQ(back->views_set[0].name, "a b.jpg");
  EXPECT_EQ(back->views_set[0].exposure_time, delta.views_set[0].exposure_time);
  ASSERT_EQ(back->landmarks_set.size(), 1U);
  EXPECT_EQ(back->landmarks_set[0].position_in_map, delta.landmarks_set[0].position_in_map);
  EXPECT_EQ(back->landmarks_set[0].color, delta.landmarks_set[0].color);
  ASSERT_EQ(back->observations_added.size(), 1U);
  EXPECT_EQ(back->observations_added[0].pixel, delta.observations_added[0].pixel);
}

TEST(MapDeltaMsg, RefusesArraysOfDifferentLength) {
  const auto refuses = [](auto spoil) {
    plumbline::MapDelta msg = MakeDeltaMsg();
    spoil(msg);
    return !FromMapDeltaMsg(msg);
  };
  EXPECT_TRUE(refuses([](auto& msg) { msg.landmarks_set.positions_in_map.pop_back(); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.landmarks_set.colors_rgb.pop_back(); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.landmarks_set.ids.push_back(1); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.observations_added.pixels_px.pop_back(); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.observations_added.photos.clear(); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.observations_removed.feature_idxs.clear(); }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.lens.pop_back(); }));
}

TEST(MapDeltaMsg, RefusesValuesThatAreNotFinite) {
  const auto refuses = [](auto spoil) {
    plumbline::MapDelta msg = MakeDeltaMsg();
    spoil(msg);
    return !FromMapDeltaMsg(msg);
  };
  EXPECT_TRUE(refuses([](auto& msg) { msg.landmarks_set.positions_in_map[1] = kNan; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.lens[0] = kNan; }));
  EXPECT_TRUE(refuses([](auto& msg) {
    msg.observations_added.pixels_px[0] = std::numeric_limits<float>::infinity();
  }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.views_set[0].cam_from_map.rotation.w = 0.0; }));
}

TEST(VerdictMsg, RoundTripKeepsAllButThePixels) {
  PhotoVerdict verdict;
  verdict.photo = PhotoId{77};
  verdict.name = "DSC_0077.JPG";
  verdict.attempt = 3;
  verdict.status = VerdictStatus::kRefused;
  verdict.reason = RefusalReason::kTooFewInliers;
  verdict.hint = "Fly back.";
  verdict.num_matches = 120;
  verdict.num_inliers = 11;
  verdict.median_error_px = 0.75;
  verdict.seconds.verdict_s = 0.5;
  verdict.inlier_pixels = {{1.0F, 2.0F}};
  const auto back = FromVerdictMsg(ToVerdictMsg(verdict, "map", ros::Time(1)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->photo, verdict.photo);
  EXPECT_EQ(back->name, verdict.name);
  EXPECT_EQ(back->attempt, 3);
  EXPECT_EQ(back->status, verdict.status);
  EXPECT_EQ(back->reason, verdict.reason);
  EXPECT_EQ(back->hint, verdict.hint);
  EXPECT_EQ(back->num_matches, 120);
  EXPECT_EQ(back->num_inliers, 11);
  EXPECT_EQ(back->median_error_px, 0.75);
  EXPECT_EQ(back->seconds.verdict_s, 0.5);
  EXPECT_TRUE(back->inlier_pixels.empty());
}

TEST(VerdictMsg, StatusIsOneOfTheConstants) {
  const auto status_of = [](VerdictStatus status) {
    PhotoVerdict verdict;
    verdict.status = status;
    return ToVerdictMsg(verdict, "map", ros::Time(1)).status;
  };
  EXPECT_EQ(status_of(VerdictStatus::kAccepted), plumbline::PhotoVerdict::ACCEPTED);
  EXPECT_EQ(status_of(VerdictStatus::kWaiting), plumbline::PhotoVerdict::WAITING);
  EXPECT_EQ(status_of(VerdictStatus::kRefused), plumbline::PhotoVerdict::REFUSED);
}

TEST(VerdictMsg, RefusesUnknownWordsNanAndCountsBeyondInt) {
  const plumbline::PhotoVerdict good = ToVerdictMsg(PhotoVerdict(), "map", ros::Time(1));
  ASSERT_TRUE(FromVerdictMsg(good));
  plumbline::PhotoVerdict msg = good;
  msg.status = "maybe";
  EXPECT_FALSE(FromVerdictMsg(msg));
  msg = good;
  msg.reason = "";
  EXPECT_FALSE(FromVerdictMsg(msg));
  msg = good;
  msg.verdict_s = kNan;
  EXPECT_FALSE(FromVerdictMsg(msg));
  msg = good;
  msg.num_inliers = 4'000'000'000U;
  EXPECT_FALSE(FromVerdictMsg(msg));
}

MarkerDetection MakeDetection() {
  MarkerDetection detection;
  detection.id = 20;
  detection.center_px = {1000.0 / 3.0, 77.25};
  detection.center_covariance_px2 << 4e-4, 1e-4, 1e-4, 9e-4;
  detection.ellipse.center_px = {333.5, 77.5};
  detection.ellipse.semi_major_px = 12.5;
  detection.ellipse.semi_minor_px = 10.25;
  detection.ellipse.angle_rad = 1.5;
  detection.pixel_from_marker << 12.0, -3.0, 333.3, 2.0, 10.0, 77.25, 0.01, -0.02, 1.0;
  detection.probability = 0.99999;
  detection.explained = 0.97;
  detection.num_corrected_bits = 2;
  return detection;
}

TEST(MarkerDetectionMsg, RoundTripKeepsAllToTheLastBit) {
  const MarkerDetection detection = MakeDetection();
  plumbline::MarkerDetectionArray msg;
  msg.detections = {ToMarkerDetectionMsg(detection)};
  EXPECT_EQ(msg.detections[0].pixel_from_marker[2], 333.3);  // Row by row.
  const auto back = FromMarkerDetectionsMsg(msg);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 1U);
  const MarkerDetection& read = back->front();
  EXPECT_EQ(read.id, detection.id);
  EXPECT_EQ(read.center_px, detection.center_px);
  EXPECT_EQ(read.center_covariance_px2, detection.center_covariance_px2);
  EXPECT_EQ(read.ellipse.center_px, detection.ellipse.center_px);
  EXPECT_EQ(read.ellipse.semi_major_px, detection.ellipse.semi_major_px);
  EXPECT_EQ(read.ellipse.semi_minor_px, detection.ellipse.semi_minor_px);
  EXPECT_EQ(read.ellipse.angle_rad, detection.ellipse.angle_rad);
  EXPECT_EQ(read.pixel_from_marker, detection.pixel_from_marker);
  EXPECT_EQ(read.probability, detection.probability);
  EXPECT_EQ(read.explained, detection.explained);
  EXPECT_EQ(read.num_corrected_bits, detection.num_corrected_bits);
}

TEST(MarkerDetectionMsg, RefusesWhatNoDetectorSays) {
  const auto refuses = [](auto spoil) {
    plumbline::MarkerDetection msg = ToMarkerDetectionMsg(MakeDetection());
    spoil(msg);
    return !FromMarkerDetectionMsg(msg);
  };
  EXPECT_FALSE(refuses([](auto&) {}));
  EXPECT_TRUE(refuses([](auto& msg) { msg.id = 106; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.id = 4'000'000'000U; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.num_corrected_bits = 18; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.center_px[1] = kNan; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.center_covariance_px2[0] = 0.0; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.center_covariance_px2[1] = 1.0; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.semi_minor_px = -1.0; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.semi_minor_px = 13.0; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.pixel_from_marker[8] = kNan; }));
  EXPECT_TRUE(refuses([](auto& msg) { msg.probability = 1.5; }));
  plumbline::MarkerDetectionArray array;
  array.detections.resize(2);
  array.detections[0] = ToMarkerDetectionMsg(MakeDetection());
  EXPECT_FALSE(FromMarkerDetectionsMsg(array));  // The other is a default message.
}

TEST(CameraInfoMsg, RoundTripKeepsBothLensModels) {
  for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial}) {
    const Camera camera = MakeCamera(model);
    EXPECT_TRUE(IsSameCamera(FromCameraInfoMsg(ToCameraInfoMsg(camera), "x"), camera));
  }
}

TEST(CameraInfoMsg, NamesTheFieldThatIsWrong) {
  const sensor_msgs::CameraInfo good = ToCameraInfoMsg(MakeCamera(DistortionModel::kPlumbBob));
  const auto message_of = [&](auto spoil) -> std::string {
    sensor_msgs::CameraInfo msg = good;
    spoil(msg);
    try {
      FromCameraInfoMsg(msg, "x");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(message_of([](auto& msg) { msg.distortion_model = "fisheye"; }),
              HasSubstr("fisheye"));
  EXPECT_THAT(message_of([](auto& msg) { msg.D.pop_back(); }), HasSubstr("D must have 5"));
  EXPECT_THAT(message_of([](auto& msg) { msg.K[1] = 0.1; }), HasSubstr("skew"));
  EXPECT_THAT(message_of([](auto& msg) { msg.binning_x = 2; }), HasSubstr("binning"));
  EXPECT_THAT(message_of([](auto& msg) { msg.roi.width = 5; }), HasSubstr("roi"));
  EXPECT_NE(message_of([](auto& msg) { msg.K[0] = -1.0; }), "nothing was thrown");
  EXPECT_NE(message_of([](auto& msg) { msg.K[4] = kNan; }), "nothing was thrown");
  EXPECT_NE(message_of([](auto& msg) { msg.width = 0; }), "nothing was thrown");
  EXPECT_NE(message_of([](auto& msg) { msg.width = 4'000'000'000U; }), "nothing was thrown");
}

WirePhoto MakePhoto() {
  WirePhoto photo;
  photo.id = PhotoId{5};
  photo.name = "IMG_5.jpg";
  photo.exposure_time = {1'700'000'000'123'456'789};
  photo.position = GeodeticPosition{48.5, -2.25, std::nullopt};
  photo.received = {1'700'000'001'000'000'000};
  photo.published = {1'700'000'001'250'000'000};
  photo.bytes = {0xFF, 0xD8, 0x00, 0xFF, 0xD9};
  return photo;
}

plumbline::Photo MakePhotoMsg() {
  return ToPhotoMsg(
      MakePhoto(), ToCameraInfoMsg(MakeCamera(DistortionModel::kPlumbBob)), "camera_optical");
}

TEST(PhotoMsg, RoundTripKeepsBytesTimesAndPosition) {
  const plumbline::Photo msg = MakePhotoMsg();
  EXPECT_EQ(msg.image.format, "jpeg");
  EXPECT_EQ(msg.camera_info.header.stamp, msg.header.stamp);
  EXPECT_EQ(msg.camera_info.header.frame_id, "camera_optical");
  const auto back = FromPhotoMsg(msg);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, PhotoId{5});
  EXPECT_EQ(back->name, "IMG_5.jpg");
  EXPECT_EQ(back->exposure_time, MakePhoto().exposure_time);
  EXPECT_EQ(back->received, MakePhoto().received);
  EXPECT_EQ(back->published, MakePhoto().published);
  EXPECT_EQ(back->bytes, MakePhoto().bytes);
  ASSERT_TRUE(back->position);
  EXPECT_EQ(back->position->lat_deg, 48.5);
  EXPECT_FALSE(back->position->alt_m);
}

TEST(PhotoMsg, AnUnknownPositionIsNoPositionAtLatitudeZero) {
  WirePhoto photo = MakePhoto();
  photo.position.reset();
  const plumbline::Photo msg = ToPhotoMsg(photo, {}, "camera_optical");
  EXPECT_EQ(msg.position_prior.status.status, sensor_msgs::NavSatStatus::STATUS_NO_FIX);
  EXPECT_TRUE(std::isnan(msg.position_prior.latitude));
  EXPECT_FALSE(FromPhotoMsg(msg)->position);
}

TEST(PhotoMsg, RefusesNoSequenceAndNamesThatAreNoFileNames) {
  for (const char* name : {"", ".", "..", "a/b.jpg", "/etc/passwd"}) {
    plumbline::Photo msg = MakePhotoMsg();
    msg.name = name;
    EXPECT_FALSE(FromPhotoMsg(msg)) << name;
  }
  plumbline::Photo msg = MakePhotoMsg();
  msg.sequence = 0;
  EXPECT_FALSE(FromPhotoMsg(msg));
}

TEST(ImageFormat, IsReadFromTheFirstBytes) {
  EXPECT_EQ(ImageFormat({0xFF, 0xD8, 0xFF}), "jpeg");
  EXPECT_EQ(ImageFormat({0x89, 'P', 'N', 'G'}), "png");
  EXPECT_EQ(ImageFormat({'M', 'M', 0, 42}), "tiff");
  EXPECT_EQ(ImageFormat({}), "");
  EXPECT_EQ(ImageFormat({'h', 'e', 'l', 'l', 'o'}), "");
}

}  // namespace
}  // namespace plumb::ros_adapter
