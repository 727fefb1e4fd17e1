// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/center_shift.h"

#include <gtest/gtest.h>

#include "plumbline/marker/marker_detector.h"
#include "test/support/calibration_scene.h"
#include "test/support/marker_scene.h"

namespace plumb {
namespace {

// A board of one marker in the plane z = 0, seen by one photo.
BoardState OneMarker(const Camera& camera, const Rigid3& cam_from_marker) {
  BoardState state;
  state.lens = camera.lens();
  state.cams_from_plane = {cam_from_marker};
  state.centers_in_plane = {Eigen::Vector3d::Zero()};
  return state;
}

Camera StrongLens() {
  LensParameters<double> lens = test::CalibrationLens();
  lens[kFx] = lens[kFy] = 700.0;
  lens[kCx] = 499.5;
  lens[kCy] = 399.5;
  lens[kK1] = -0.2;
  lens[kK2] = 0.03;
  return test::CalibrationCamera(lens, 1000, 800);
}

TEST(CenterShift, IsNothingWithoutDistortion) {
  const Camera camera = test::CalibrationCamera(
      {1361.7, 1361.7, 1002.9, 664.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  const Rigid3 cam_from_plane(
      Eigen::Quaterniond(Eigen::AngleAxisd(2.6, Eigen::Vector3d(0.8, 0.6, 0.0))), {1.0, -0.5, 4.0});
  EXPECT_LT(CenterShift({}, OneMarker(camera, cam_from_plane)).norm(), 1e-9);
}

// What the detector itself makes of a large marker under a strong lens.
TEST(CenterShift, IsWhatADetectorWithoutTheLensSees) {
  const Camera camera = StrongLens();
  const Rigid3 cam_from_face = test::PlaceMarker(camera, {740.0, 250.0}, 230.0, 0.5, 0.7, 0.3);
  test::PhotoConditions conditions;
  conditions.noise = 0.5;
  const cv::Mat photo = RenderPhoto(camera, {{test::MarkerFace(7), cam_from_face}}, conditions);
  const std::vector<MarkerDetection> found = DetectMarkers({}, photo);
  ASSERT_EQ(found.size(), 1U);
  const Eigen::Vector2d truth = *camera.Project(cam_from_face.translation);
  const Eigen::Vector2d seen = found[0].center_px - truth;
  // The board's unit is a diameter, the face's a radius.
  const Rigid3 cam_from_plane(cam_from_face.rotation, 0.5 * cam_from_face.translation);
  const Eigen::Vector2d shift = CenterShift({}, OneMarker(camera, cam_from_plane));
  EXPECT_GT(seen.norm(), 0.1);
  // The code of this marker has its borders elsewhere than an average one.
  EXPECT_LT((seen - shift).norm(), 0.4 * seen.norm());
}

}  // namespace
}  // namespace plumb
