// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::MakeScene;
using test::Random;
using test::Scene;
using test::SceneMatches;
using test::SceneOptions;

// The squared reprojection error in normalised coordinates, computed anew.
double Cost(const std::vector<NormalizedObservation>& observations, const Eigen::Vector3d& point) {
  double cost = 0.0;
  for (const NormalizedObservation& observation : observations) {
    const Eigen::Vector3d in_cam = *observation.cam_from_map * point;
    cost += (in_cam.hnormalized() - observation.xy).squaredNorm();
  }
  return cost;
}

// Observations by point of the points seen in every camera.
std::vector<std::vector<NormalizedObservation>> Tracks(const Scene& scene) {
  std::vector<std::vector<NormalizedObservation>> tracks(scene.points_in_map.size());
  for (std::size_t k = 0; k < scene.observations.size(); ++k) {
    for (const test::SceneObservation& observation : scene.observations[k]) {
      tracks[static_cast<std::size_t>(observation.point_idx)].push_back(
          {&scene.cams_from_map[k], observation.xy});
    }
  }
  return tracks;
}

TEST(TriangulateTwoViews, FindsExactPoints) {
  const Scene scene = MakeScene();
  const SceneMatches matches = MatchScene(scene, 0, 1);
  ASSERT_GT(matches.xy1.size(), 300u);
  for (std::size_t i = 0; i < matches.xy1.size(); ++i) {
    const auto point = TriangulateTwoViews(
        scene.cams_from_map[0], scene.cams_from_map[1], matches.xy1[i], matches.xy2[i]);
    ASSERT_TRUE(point);
    const auto& truth = scene.points_in_map[static_cast<std::size_t>(matches.point_idx[i])];
    EXPECT_LT((*point - truth).norm(), 1e-8);  // [m]; unprojection is exact to 1e-9 px.
  }
}

TEST(TriangulateTwoViews, IsOptimalUnderNoise) {  // Brute force: no neighbour is better.
  SceneOptions options;
  options.noise_px = 2.0;
  const Scene scene = MakeScene(options);
  const SceneMatches matches = MatchScene(scene, 0, 1);
  for (std::size_t i = 0; i < matches.xy1.size(); i += 10) {
    const std::vector<NormalizedObservation> observations = {
        {&scene.cams_from_map[0], matches.xy1[i]}, {&scene.cams_from_map[1], matches.xy2[i]}};
    const auto point = TriangulateTwoViews(
        scene.cams_from_map[0], scene.cams_from_map[1], matches.xy1[i], matches.xy2[i]);
    ASSERT_TRUE(point);
    const double cost = Cost(observations, *point);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step_m : {-1e-3, 1e-3}) {
        EXPECT_LT(cost, Cost(observations, *point + step_m * Eigen::Vector3d::Unit(axis)));
      }
    }
  }
}

TEST(TriangulateTwoViews, MovesWithTheMapFrame) {  // Law: no hidden origin.
  SceneOptions options;
  options.noise_px = 1.0;
  const Scene scene = MakeScene(options);
  const SceneMatches matches = MatchScene(scene, 0, 1);
  const Rigid3 other_from_map(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1e3, -2e3, 40.0});
  const Rigid3 cam1_from_other = scene.cams_from_map[0] * other_from_map.Inverse();
  const Rigid3 cam2_from_other = scene.cams_from_map[1] * other_from_map.Inverse();
  for (std::size_t i = 0; i < matches.xy1.size(); i += 10) {
    const auto in_map = TriangulateTwoViews(
        scene.cams_from_map[0], scene.cams_from_map[1], matches.xy1[i], matches.xy2[i]);
    const auto in_other =
        TriangulateTwoViews(cam1_from_other, cam2_from_other, matches.xy1[i], matches.xy2[i]);
    ASSERT_TRUE(in_map && in_other);
    EXPECT_LT((other_from_map * *in_map - *in_other).norm(), 1e-7);
  }
}

TEST(TriangulateTwoViews, FindsNothingForParallelRays) {
  const Rigid3 cam1_from_map;
  const Rigid3 cam2_from_map(Eigen::Quaterniond::Identity(), {-1.0, 0.0, 0.0});
  EXPECT_FALSE(TriangulateTwoViews(cam1_from_map, cam2_from_map, {0.1, 0.2}, {0.1, 0.2}));
}

TEST(TriangulateTwoViews, FindsNothingWithoutABaseline) {
  const Rigid3 cam_from_map;
  EXPECT_FALSE(TriangulateTwoViews(cam_from_map, cam_from_map, {0.1, 0.2}, {0.1, 0.2}));
  EXPECT_FALSE(TriangulateTwoViews(cam_from_map, cam_from_map, {0.1, 0.2}, {0.3, 0.2}));
}

TEST(TriangulateTwoViews, FindsNothingBehindTheCameras) {
  const Rigid3 cam1_from_map;
  const Rigid3 cam2_from_map(Eigen::Quaterniond::Identity(), {-1.0, 0.0, 0.0});
  // Rays that meet 5 m ahead, and the same that part: they meet 5 m behind.
  EXPECT_TRUE(TriangulateTwoViews(cam1_from_map, cam2_from_map, {0.1, 0.0}, {-0.1, 0.0}));
  EXPECT_FALSE(TriangulateTwoViews(cam1_from_map, cam2_from_map, {-0.1, 0.0}, {0.1, 0.0}));
}

TEST(TriangulateTwoViews, FindsNothingBehindOneCamera) {
  // Back to back: what one sees in front, the other has behind it.
  const Rigid3 cam1_from_map;
  const Rigid3 cam2_from_map(Eigen::Quaterniond(Eigen::AngleAxisd(3.14, Eigen::Vector3d::UnitY())),
                             {1.0, 0.0, 0.0});
  const Eigen::Vector3d point(0.3, 0.2, 5.0);
  const Eigen::Vector3d in_cam2 = cam2_from_map * point;
  ASSERT_LT(in_cam2.z(), 0.0);
  EXPECT_FALSE(TriangulateTwoViews(
      cam1_from_map, cam2_from_map, point.hnormalized(), in_cam2.hnormalized()));
}

TEST(TriangulateViews, FindsExactPoints) {
  SceneOptions options;
  options.num_cameras = 5;
  const Scene scene = MakeScene(options);
  const auto tracks = Tracks(scene);
  int num_triangulated = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].size() < 2) continue;
    const auto point = TriangulateViews(tracks[i]);
    ASSERT_TRUE(point);
    EXPECT_LT((*point - scene.points_in_map[i]).norm(), 1e-8);
    ++num_triangulated;
  }
  EXPECT_GT(num_triangulated, 400);
}

TEST(TriangulateViews, EndsWhereTheNumericGradientVanishes) {
  SceneOptions options;
  options.num_cameras = 6;
  options.noise_px = 2.0;
  const Scene scene = MakeScene(options);
  constexpr double kStep_m = 1e-4;
  for (const auto& track : Tracks(scene)) {
    if (track.size() < 3) continue;
    const auto point = TriangulateViews(track);
    ASSERT_TRUE(point);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
      const double ahead = Cost(track, *point + step);
      const double behind = Cost(track, *point - step);
      const double curvature = (ahead + behind - 2.0 * Cost(track, *point)) / (kStep_m * kStep_m);
      const double gradient = (ahead - behind) / (2.0 * kStep_m);
      EXPECT_LT(std::abs(gradient / curvature), 1e-5);  // Distance to the minimum [m].
    }
  }
}

TEST(TriangulateViews, KeepsItsDigitsFarFromTheMapsOrigin) {
  SceneOptions options;
  options.num_cameras = 4;
  const Scene scene = MakeScene(options);
  const Eigen::Vector3d offset(5e5, 6e6, 300.0);  // UTM.
  std::vector<Rigid3> cams_from_far;
  for (const Rigid3& cam_from_map : scene.cams_from_map) {
    const Eigen::Vector3d center = cam_from_map.TargetOriginInSource() + offset;
    cams_from_far.emplace_back(cam_from_map.rotation, -(cam_from_map.rotation * center));
  }
  auto tracks = Tracks(scene);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].size() < 2) continue;
    for (NormalizedObservation& observation : tracks[i]) {
      observation.cam_from_map = &cams_from_far[static_cast<std::size_t>(
          observation.cam_from_map - scene.cams_from_map.data())];
    }
    const auto point = TriangulateViews(tracks[i]);
    ASSERT_TRUE(point);
    EXPECT_LT((*point - offset - scene.points_in_map[i]).norm(), 1e-6);
  }
}

TEST(TriangulateViews, AgreesWithTwoViews) {
  SceneOptions options;
  options.noise_px = 1.0;
  const Scene scene = MakeScene(options);
  for (const auto& track : Tracks(scene)) {
    if (track.size() != 2) continue;
    const auto two = TriangulateTwoViews(
        *track[0].cam_from_map, *track[1].cam_from_map, track[0].xy, track[1].xy);
    const auto any = TriangulateViews(track);
    ASSERT_TRUE(two && any);
    EXPECT_LT((*two - *any).norm(), 1e-5);  // Two Gauss-Newton steps against convergence.
  }
}

TEST(TriangulateViews, FindsNothingForFewerThanTwoViews) {
  const Rigid3 cam_from_map;
  EXPECT_FALSE(TriangulateViews({}));
  EXPECT_FALSE(TriangulateViews({{&cam_from_map, {0.1, 0.2}}}));
}

TEST(TriangulateViews, FindsNothingWhereAllCentersAgree) {
  const Rigid3 cam1_from_map;
  const Rigid3 cam2_from_map(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())),
                             Eigen::Vector3d::Zero());
  const Eigen::Vector3d point(0.5, 0.3, 8.0);
  EXPECT_FALSE(TriangulateViews({{&cam1_from_map, point.hnormalized()},
                                 {&cam2_from_map, (cam2_from_map * point).hnormalized()}}));
}

TEST(TriangulateViews, FindsNothingForParallelRaysOrBehindACamera) {
  const Rigid3 cam1_from_map;
  const Rigid3 cam2_from_map(Eigen::Quaterniond::Identity(), {-1.0, 0.0, 0.0});
  const Rigid3 cam3_from_map(Eigen::Quaterniond::Identity(), {-2.0, 0.0, 0.0});
  EXPECT_FALSE(TriangulateViews(
      {{&cam1_from_map, {0.1, 0.0}}, {&cam2_from_map, {0.1, 0.0}}, {&cam3_from_map, {0.1, 0.0}}}));
  EXPECT_FALSE(TriangulateViews(
      {{&cam1_from_map, {-0.2, 0.0}}, {&cam2_from_map, {0.0, 0.0}}, {&cam3_from_map, {0.2, 0.0}}}));
}

TEST(ParallaxAngle, MeasuresKnownTriangles) {
  EXPECT_DOUBLE_EQ(ParallaxAngle({0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}), M_PI / 2.0);
  EXPECT_DOUBLE_EQ(ParallaxAngle({0, 0, 0}, {0, 0, 0}, {0.5, 0.5, 0}), 0.0);
  EXPECT_DOUBLE_EQ(ParallaxAngle({-1, 0, 0}, {1, 0, 0}, {0, 0, 0}), M_PI);
  // Small angles keep their digits, which an arc cosine would lose.
  EXPECT_NEAR(ParallaxAngle({0, 0, 0}, {1, 0, 0}, {0, 0, 1e9}), 1e-9, 1e-20);
}

}  // namespace
}  // namespace plumb
