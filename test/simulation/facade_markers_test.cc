// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The control points' plates of a facade are coded markers, found where the truth says they are.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "plumbline/marker/marker_detector.h"
#include "plumbline/simulation/renderer.h"
#include "test/simulation/small_facade.h"

namespace plumb {
namespace {

using Eigen::Vector3d;

// Before the wall, looking straight at it.
Rigid3 CamBefore(const Vector3d& point_in_world, double distance_m) {
  Eigen::Matrix3d cam_from_world;
  cam_from_world << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Vector3d center = point_in_world - Vector3d(0.0, distance_m, 0.0);
  return Rigid3(Eigen::Quaterniond(cam_from_world), -(cam_from_world * center));
}

cv::Mat GrayOf(const cv::Mat& radiance) {
  cv::Mat gray;
  cv::cvtColor(radiance, gray, cv::COLOR_BGR2GRAY);
  gray.convertTo(gray, CV_8U, 200.0);
  return gray;
}

TEST(FacadeMarkers, AreFoundWhereTheTruthSays) {
  const World world = BuildFacade(test::SmallFacade());
  const Renderer renderer(world);
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 800.0;
  lens[kCx] = 319.5;
  lens[kCy] = 239.5;
  lens[kK1] = -0.1;
  const Camera camera("test", 640, 480, DistortionModel::kPlumbBob, lens);
  ASSERT_EQ(world.plates.size(), 5U);
  for (const Plate& plate : world.plates) {
    const Rigid3 cam_from_world =
        CamBefore(plate.world_from_plate.translation + Vector3d(0.6, 0.0, 0.4), 5.0);
    const cv::Mat gray = GrayOf(renderer.Render(camera, cam_from_world, Light{}));
    const auto detections = DetectMarkers(MarkerDetectorOptions{}, gray, &camera);
    ASSERT_EQ(detections.size(), 1U) << "plate " << plate.id;
    EXPECT_EQ(detections[0].id, plate.id);
    const auto pixel = camera.Project(cam_from_world * plate.world_from_plate.translation);
    EXPECT_LT((detections[0].center_px - *pixel).norm(), 0.05);
    EXPECT_NEAR(detections[0].ellipse.semi_minor_px, 0.25 / 5.0 * 800.0, 1.0);
  }
}

}  // namespace
}  // namespace plumb
