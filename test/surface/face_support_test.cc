// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_support.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plumbline/surface/surface_report.h"

namespace plumb {
namespace {

constexpr double kMaxEdgeRatio = 0.05;
constexpr double kDistance_m = 5.0;

// A triangle in y = 0 of this side, seen by all cameras; its free side is that of the negative y.
class TriangleScene {
 public:
  TriangleScene(double side_m, const std::vector<Eigen::Vector3d>& cameras)
      : scene_(SurfaceOptions()) {
    MapDelta map;
    map.is_snapshot = true;
    map.landmarks_set = {{LandmarkId{1}, {0, 0, 0}, {0, 0, 0}},
                         {LandmarkId{2}, {side_m, 0, 0}, {0, 0, 0}},
                         {LandmarkId{3}, {0, 0, side_m}, {0, 0, 0}}};
    for (std::uint32_t i = 0; i < cameras.size(); ++i) {
      ViewState view;
      view.photo = PhotoId{i};
      view.cam_from_map = Rigid3(Eigen::Quaterniond::Identity(), -cameras[i]);
      map.views_set.push_back(view);
      for (const LandmarkState& landmark : map.landmarks_set) {
        map.observations_added.push_back({landmark.id, PhotoId{i}, 0, {0, 0}});
      }
    }
    SurfaceReport report;
    scene_.Apply(map, &report);
  }

  bool IsSupported() const {
    FaceSlots slots = {kNoSlot, kNoSlot, kNoSlot};
    for (const Slot slot : scene_.PlacedSlots()) slots.at(scene_.IdOf(slot).value - 1) = slot;
    return FaceSupport(scene_, kMaxEdgeRatio).IsSupported(slots);
  }

 private:
  RayScene scene_;
};

// A camera before the wall, so many degrees off its normal.
Eigen::Vector3d CameraAt(double angle_deg) {
  const double angle_rad = angle_deg * M_PI / 180.0;
  return {kDistance_m * std::sin(angle_rad), -kDistance_m * std::cos(angle_rad), 0.0};
}

TEST(FaceSupport, IsGivenFromInFrontAndNotFromBehind) {
  EXPECT_TRUE(TriangleScene(0.1, {CameraAt(0)}).IsSupported());
  EXPECT_TRUE(TriangleScene(0.1, {CameraAt(60)}).IsSupported());
  EXPECT_FALSE(TriangleScene(0.1, {CameraAt(120)}).IsSupported());
  EXPECT_FALSE(TriangleScene(0.1, {CameraAt(180)}).IsSupported());
}

TEST(FaceSupport, IsNotGivenByCamerasNearlyInThePlane) {
  EXPECT_TRUE(TriangleScene(0.1, {CameraAt(72)}).IsSupported());
  EXPECT_FALSE(TriangleScene(0.1, {CameraAt(84)}).IsSupported());
  EXPECT_TRUE(TriangleScene(0.1, {CameraAt(84), CameraAt(20)}).IsSupported());
}

TEST(FaceSupport, EndsWithTheLengthOfTheEdges) {
  const double longest_m = std::sqrt(2.0) * 0.1;  // Of a side of 0.1 m.
  const double most_m = 2.0 * kMaxEdgeRatio * kDistance_m;
  EXPECT_TRUE(TriangleScene(0.095 * most_m / longest_m, {CameraAt(0)}).IsSupported());
  EXPECT_FALSE(TriangleScene(0.105 * most_m / longest_m, {CameraAt(0)}).IsSupported());
}

}  // namespace
}  // namespace plumb
