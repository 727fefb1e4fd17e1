// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/absolute_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::Random;
using test::Scene;
using test::SceneOptions;

constexpr double kFocal_px = 2500.0;

struct PoseMatches {
  Rigid3 cam_from_map;
  std::vector<Eigen::Vector2d> xy;
  std::vector<Eigen::Vector3d> points_in_map;
  std::vector<char> is_true;
};

PoseMatches MakeMatches(const SceneOptions& options) {
  const Scene scene = test::MakeScene(options);
  PoseMatches matches;
  matches.cam_from_map = scene.cams_from_map[0];
  for (const test::SceneObservation& observation : scene.observations[0]) {
    matches.xy.push_back(observation.xy);
    matches.points_in_map.push_back(
        scene.points_in_map[static_cast<std::size_t>(observation.point_idx)]);
    matches.is_true.push_back(observation.is_outlier ? 0 : 1);
  }
  return matches;
}

double CenterDistance(const Rigid3& a, const Rigid3& b) {
  return (a.TargetOriginInSource() - b.TargetOriginInSource()).norm();
}

double Distance(const Rigid3& a, const Rigid3& b) {
  return a.rotation.angularDistance(b.rotation) + (a.translation - b.translation).norm();
}

double HuberCostOf(const Rigid3& cam_from_map, const PoseMatches& matches, double width) {
  double cost = 0.0;
  for (std::size_t i = 0; i < matches.xy.size(); ++i) {
    const Eigen::Vector3d in_cam = cam_from_map * matches.points_in_map[i];
    const double error = (in_cam.hnormalized() - matches.xy[i]).norm();
    cost += error <= width ? error * error : width * (2.0 * error - width);
  }
  return cost;
}

AbsolutePoseOptions MakeOptions(double max_error_px) {
  AbsolutePoseOptions options;
  options.max_error = max_error_px / kFocal_px;
  return options;
}

TEST(SolveP3P, HasTheTrueAndOnlyExactPoses) {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const Rigid3 cam_from_map = random.Pose(5.0);
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d in_cam = random.InBox(1.0) + Eigen::Vector3d(0.0, 0.0, 4.0);
      rays[i] = in_cam.normalized();
      points[i] = cam_from_map.Inverse() * in_cam;
    }
    const std::vector<Rigid3> poses = SolveP3P(rays, points);
    ASSERT_LE(poses.size(), 4u);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Rigid3& pose : poses) {
      nearest = std::min(nearest, Distance(pose, cam_from_map));
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(((pose * points[i]).normalized() - rays[i]).norm(), 1e-6) << "trial " << trial;
      }
    }
    EXPECT_LT(nearest, 1e-6) << "trial " << trial;
  }
}

TEST(SolveP3P, FindsAllFourPosesOfASymmetricView) {
  // Seen from above the centre, an equilateral triangle allows the symmetric pose and three
  // in which one corner comes nearer (Fischler & Bolles, CACM 24(6), 1981, fig. 5).
  std::array<Eigen::Vector3d, 3> rays;
  std::array<Eigen::Vector3d, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 2.0 * M_PI * static_cast<double>(i) / 3.0;
    points[i] = {std::cos(angle), std::sin(angle), 0.0};
    rays[i] = Eigen::Vector3d(points[i].x(), points[i].y(), 2.0).normalized();
  }
  EXPECT_EQ(SolveP3P(rays, points).size(), 4u);
}

TEST(SolveP3P, FindsNothingForCollinearPointsOrEqualRays) {
  const std::array<Eigen::Vector3d, 3> rays = {Eigen::Vector3d(-0.1, 0.0, 1.0).normalized(),
                                               Eigen::Vector3d(0.0, 0.0, 1.0),
                                               Eigen::Vector3d(0.1, 0.1, 1.0).normalized()};
  EXPECT_TRUE(SolveP3P(rays, {Eigen::Vector3d(0, 0, 0), {1, 1, 1}, {2, 2, 2}}).empty());
  EXPECT_TRUE(SolveP3P(rays, {Eigen::Vector3d(0, 0, 0), {0, 0, 0}, {2, 0, 2}}).empty());
  EXPECT_TRUE(
      SolveP3P({rays[0], rays[0], rays[2]}, {Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}})
          .empty());
}

TEST(EstimateAbsolutePose, FindsTheExactPose) {
  const PoseMatches matches = MakeMatches({});
  const auto result = EstimateAbsolutePose(MakeOptions(2.0), matches.xy, matches.points_in_map);
  ASSERT_TRUE(result);
  EXPECT_LT(Distance(result->cam_from_map, matches.cam_from_map), 1e-8);
  EXPECT_EQ(result->num_inliers, static_cast<int>(matches.xy.size()));
}

TEST(EstimateAbsolutePose, SeparatesTrueFromFalseMatches) {
  SceneOptions options;
  options.num_points = 1000;
  options.noise_px = 0.7;
  options.outlier_ratio = 0.5;
  const PoseMatches matches = MakeMatches(options);
  const auto result = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
  ASSERT_TRUE(result);
  EXPECT_LT(CenterDistance(result->cam_from_map, matches.cam_from_map), 0.01);  // At 10 m.
  int num_wrong = 0;
  for (std::size_t i = 0; i < matches.xy.size(); ++i) {
    num_wrong += result->is_inlier[i] != matches.is_true[i] ? 1 : 0;
  }
  EXPECT_LE(num_wrong, 3);  // By chance a random pixel may lie within 3 px.
  EXPECT_EQ(result->num_inliers, std::count(result->is_inlier.begin(), result->is_inlier.end(), 1));
}

TEST(EstimateAbsolutePose, WorksAtTenPercentInliersOfFiveThousand) {
  SceneOptions options;
  options.num_points = 6000;
  options.noise_px = 0.7;
  options.outlier_ratio = 0.9;
  for (int seed = 1; seed <= 5; ++seed) {
    options.random_seed = seed;
    const PoseMatches matches = MakeMatches(options);
    const auto result = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
    ASSERT_TRUE(result);
    EXPECT_LT(CenterDistance(result->cam_from_map, matches.cam_from_map), 0.02);
  }
}

TEST(EstimateAbsolutePose, WorksOnAnExactPlane) {
  SceneOptions options;
  options.relief_m = 0.0;
  options.noise_px = 0.7;
  options.outlier_ratio = 0.4;
  const PoseMatches matches = MakeMatches(options);
  const auto result = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
  ASSERT_TRUE(result);
  EXPECT_LT(CenterDistance(result->cam_from_map, matches.cam_from_map), 0.02);
}

TEST(EstimateAbsolutePose, RepeatsItselfForASeed) {
  SceneOptions options;
  options.noise_px = 1.0;
  options.outlier_ratio = 0.7;
  const PoseMatches matches = MakeMatches(options);
  const auto first = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
  const auto second = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->cam_from_map.Matrix(), second->cam_from_map.Matrix());
  EXPECT_EQ(first->is_inlier, second->is_inlier);
  EXPECT_EQ(first->num_iterations, second->num_iterations);
}

TEST(EstimateAbsolutePose, DrawsFewerSamplesWithMoreInliers) {
  SceneOptions options;
  options.noise_px = 0.7;
  std::vector<int> iterations;
  for (const double outlier_ratio : {0.2, 0.6, 0.8}) {
    options.outlier_ratio = outlier_ratio;
    const PoseMatches matches = MakeMatches(options);
    iterations.push_back(
        EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map)->num_iterations);
  }
  EXPECT_LT(iterations[0], iterations[1]);
  EXPECT_LT(iterations[1], iterations[2]);
}

TEST(EstimateAbsolutePose, MovesWithTheMapFrame) {
  SceneOptions options;
  options.noise_px = 1.0;
  options.outlier_ratio = 0.3;
  const PoseMatches matches = MakeMatches(options);
  const Rigid3 other_from_map(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {100.0, -200.0, 40.0});
  std::vector<Eigen::Vector3d> points_in_other;
  for (const Eigen::Vector3d& point : matches.points_in_map) {
    points_in_other.push_back(other_from_map * point);
  }
  const auto in_map = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, matches.points_in_map);
  const auto in_other = EstimateAbsolutePose(MakeOptions(3.0), matches.xy, points_in_other);
  ASSERT_TRUE(in_map && in_other);
  EXPECT_EQ(in_map->is_inlier, in_other->is_inlier);
  // [m]; both ends of the search stop at the noise of 1e-12 of the cost.
  EXPECT_LT(Distance(in_other->cam_from_map * other_from_map, in_map->cam_from_map), 1e-4);
}

TEST(EstimateAbsolutePose, FindsNothingInNoiseOrInTooLittle) {
  Random random(9);
  std::vector<Eigen::Vector2d> xy;
  std::vector<Eigen::Vector3d> points;
  EXPECT_FALSE(EstimateAbsolutePose(MakeOptions(2.0), xy, points));
  for (int i = 0; i < 3; ++i) {
    xy.push_back(random.Normal2(0.3));
    points.push_back(random.InBox(5.0));
  }
  EXPECT_FALSE(EstimateAbsolutePose(MakeOptions(2.0), xy, points));
  // Five random matches have no pose that fits four of them.
  for (int i = 0; i < 2; ++i) {
    xy.push_back(random.Normal2(0.3));
    points.push_back(random.InBox(5.0));
  }
  EXPECT_FALSE(EstimateAbsolutePose(MakeOptions(0.01), xy, points));
}

TEST(EstimateAbsolutePose, FindsNothingForCollinearPoints) {
  std::vector<Eigen::Vector2d> xy;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 50; ++i) {
    points.emplace_back(0.1 * i, 0.2 * i, 10.0 + 0.1 * i);
    xy.push_back(points.back().hnormalized());
  }
  EXPECT_FALSE(EstimateAbsolutePose(MakeOptions(2.0), xy, points));
}

TEST(EstimateAbsolutePose, RefusesBrokenPreconditions) {
  EXPECT_THROW(EstimateAbsolutePose(MakeOptions(2.0), {{0.0, 0.0}}, {}), std::logic_error);
  EXPECT_THROW(EstimateAbsolutePose(MakeOptions(0.0), {}, {}), std::logic_error);
}

Rigid3 Disturbed(const Rigid3& cam_from_map) {
  return Rigid3(Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.6, 0.8, 0.0))),
                {0.2, -0.1, 0.3}) *
         cam_from_map;
}

TEST(RefineAbsolutePose, ReturnsToTheExactPose) {
  const PoseMatches matches = MakeMatches({});
  const Rigid3 refined = RefineAbsolutePose(
      Disturbed(matches.cam_from_map), matches.xy, matches.points_in_map, matches.is_true, 1.0);
  EXPECT_LT(Distance(refined, matches.cam_from_map), 1e-8);
}

TEST(RefineAbsolutePose, EndsWhereTheNumericGradientOfHubersCostVanishes) {
  SceneOptions options;
  options.noise_px = 1.5;
  const PoseMatches matches = MakeMatches(options);
  const double width = 1.0 / kFocal_px;  // Many errors lie on either side.
  const std::vector<char> all(matches.xy.size(), 1);
  const Rigid3 refined = RefineAbsolutePose(
      Disturbed(matches.cam_from_map), matches.xy, matches.points_in_map, all, width);
  const double cost = HuberCostOf(refined, matches, width);
  constexpr double kStep = 1e-6;  // [rad] or [m].
  for (int axis = 0; axis < 6; ++axis) {
    const auto moved = [&](double step) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis % 3);
      const Rigid3 change =
          axis < 3 ? Rigid3(Eigen::Quaterniond(Eigen::AngleAxisd(step, unit)), {0, 0, 0})
                   : Rigid3(Eigen::Quaterniond::Identity(), step * unit);
      return HuberCostOf(change * refined, matches, width);
    };
    const double slope = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    const double curvature = (moved(1e-4) + moved(-1e-4) - 2.0 * cost) / 1e-8;
    EXPECT_LT(std::abs(slope / curvature), 1e-5) << "axis " << axis;  // Distance to the minimum.
  }
}

TEST(RefineAbsolutePose, BearsAFewWrongMatchesAmongTheInliers) {
  SceneOptions options;
  options.noise_px = 0.5;
  options.outlier_ratio = 0.05;
  const PoseMatches matches = MakeMatches(options);
  const std::vector<char> all(matches.xy.size(), 1);
  const auto center_error = [&](double width_px) {
    return CenterDistance(RefineAbsolutePose(Disturbed(matches.cam_from_map),
                                             matches.xy,
                                             matches.points_in_map,
                                             all,
                                             width_px / kFocal_px),
                          matches.cam_from_map);
  };
  EXPECT_LT(center_error(1.0), 0.02);                     // [m]
  EXPECT_LT(5.0 * center_error(1.0), center_error(1e6));  // Plain least squares.
}

TEST(RefineAbsolutePose, LeavesOutliersAndWeightlessMatchesOut) {
  SceneOptions options;
  options.outlier_ratio = 0.3;
  const PoseMatches matches = MakeMatches(options);
  const Rigid3 initial = Disturbed(matches.cam_from_map);
  const Rigid3 by_flag =
      RefineAbsolutePose(initial, matches.xy, matches.points_in_map, matches.is_true, 1.0);
  EXPECT_LT(Distance(by_flag, matches.cam_from_map), 1e-8);
  const std::vector<char> all(matches.xy.size(), 1);
  const std::vector<double> weights(matches.is_true.begin(), matches.is_true.end());
  const Rigid3 by_weight =
      RefineAbsolutePose(initial, matches.xy, matches.points_in_map, all, 1.0, weights);
  EXPECT_LT(Distance(by_weight, matches.cam_from_map), 1e-8);
}

TEST(RefineAbsolutePose, GivesTheInitialPoseWithoutThreeMatches) {
  const Rigid3 initial = Random(4).Pose();
  const Eigen::Vector3d ahead = initial.Inverse() * Eigen::Vector3d(0.1, 0.1, 5.0);
  const Eigen::Vector3d behind = initial.Inverse() * Eigen::Vector3d(0.1, 0.1, -5.0);
  const Rigid3 refined = RefineAbsolutePose(
      initial, {{0.0, 0.0}, {0.1, 0.0}, {0.2, 0.0}}, {ahead, ahead, behind}, {1, 1, 1}, 1.0);
  EXPECT_EQ(refined.Matrix(), initial.Matrix());
}

}  // namespace
}  // namespace plumb
