// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/relative_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::MakeScene;
using test::MatchScene;
using test::RelativePose;
using test::Scene;
using test::SceneMatches;
using test::SceneOptions;

constexpr double kFocal_px = 2500.0;

TwoViewOptions MakeOptions(double max_error_px) {
  TwoViewOptions options;
  options.max_error = max_error_px / kFocal_px;
  return options;
}

double DirectionAngle(const Rigid3& a, const Rigid3& b) {
  return std::atan2(a.translation.cross(b.translation).norm(), a.translation.dot(b.translation));
}

// Scenes from an exact plane to a deep one, the cameras moving along the facade.
SceneOptions NoisyFacade(double relief_m) {
  SceneOptions options;
  options.relief_m = relief_m;
  options.noise_px = 0.7;
  options.outlier_ratio = 0.25;  // Of either view: 44 % of the matches.
  return options;
}

TEST(EstimateTwoView, FindsTheExactPoseOfAGeneralScene) {
  const Scene scene = MakeScene();
  const SceneMatches matches = MatchScene(scene, 0, 1);
  const auto result = EstimateTwoView(MakeOptions(2.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(result);
  const Rigid3 truth = RelativePose(scene, 0, 1);
  EXPECT_LT(result->cam2_from_cam1.rotation.angularDistance(truth.rotation), 1e-7);
  EXPECT_LT(DirectionAngle(result->cam2_from_cam1, truth), 1e-6);
  EXPECT_NEAR(result->cam2_from_cam1.translation.norm(), 1.0, 1e-12);
  EXPECT_EQ(result->num_inliers, static_cast<int>(matches.xy1.size()));
  EXPECT_LT(result->num_homography_inliers, result->num_essential_inliers / 2);
  EXPECT_FALSE(result->is_ambiguous);
}

TEST(EstimateTwoView, FindsTheExactPoseOfAPlane) {
  SceneOptions options;
  options.relief_m = 0.0;
  const Scene scene = MakeScene(options);
  const SceneMatches matches = MatchScene(scene, 0, 1);
  const auto result = EstimateTwoView(MakeOptions(2.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(result);
  const Rigid3 truth = RelativePose(scene, 0, 1);
  EXPECT_LT(result->cam2_from_cam1.rotation.angularDistance(truth.rotation), 1e-6);
  EXPECT_LT(DirectionAngle(result->cam2_from_cam1, truth), 1e-5);
  EXPECT_EQ(result->num_homography_inliers, static_cast<int>(matches.xy1.size()));
  EXPECT_FALSE(result->is_ambiguous);
}

TEST(EstimateTwoView, BearsNoiseAndOutliersFromPlanarToDeepScenes) {
  for (const double relief_m : {0.0, 0.02, 0.1, 0.3, 1.0, 3.0}) {
    for (int seed = 1; seed <= 5; ++seed) {
      SceneOptions options = NoisyFacade(relief_m);
      options.random_seed = seed;
      const Scene scene = MakeScene(options);
      const SceneMatches matches = MatchScene(scene, 0, 1);
      const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
      ASSERT_TRUE(result) << "relief " << relief_m << " m, seed " << seed;
      const Rigid3 truth = RelativePose(scene, 0, 1);
      EXPECT_LT(result->cam2_from_cam1.rotation.angularDistance(truth.rotation), 0.003)
          << "relief " << relief_m << " m, seed " << seed;
      EXPECT_LT(DirectionAngle(result->cam2_from_cam1, truth), 0.02)
          << "relief " << relief_m << " m, seed " << seed;
      EXPECT_FALSE(result->is_ambiguous) << "relief " << relief_m << " m, seed " << seed;
    }
  }
}

TEST(EstimateTwoView, SeparatesTrueFromFalseMatches) {
  const SceneMatches matches = MatchScene(MakeScene(NoisyFacade(1.0)), 0, 1);
  const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(result);
  int num_true_lost = 0;
  int num_false_kept = 0;
  for (std::size_t i = 0; i < matches.xy1.size(); ++i) {
    if (matches.is_outlier[i] && result->is_inlier[i]) ++num_false_kept;
    if (!matches.is_outlier[i] && !result->is_inlier[i]) ++num_true_lost;
  }
  EXPECT_LE(num_true_lost, 2);
  EXPECT_LE(num_false_kept, 8);  // A random pixel may lie near the epipolar line.
  EXPECT_EQ(result->num_inliers, std::count(result->is_inlier.begin(), result->is_inlier.end(), 1));
}

TEST(EstimateTwoView, TellsThatAPlaneApproachedIsAmbiguous) {
  SceneOptions options = NoisyFacade(0.0);
  options.approach_m = 1.5;
  for (int seed = 1; seed <= 5; ++seed) {
    options.random_seed = seed;
    const SceneMatches matches = MatchScene(MakeScene(options), 0, 1);
    const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->is_ambiguous) << "seed " << seed;
  }
}

TEST(EstimateTwoView, ResolvesTheAmbiguityOfAnApproachByRelief) {
  SceneOptions options = NoisyFacade(1.0);
  options.approach_m = 1.5;
  const Scene scene = MakeScene(options);
  const SceneMatches matches = MatchScene(scene, 0, 1);
  const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->is_ambiguous);
  EXPECT_LT(DirectionAngle(result->cam2_from_cam1, RelativePose(scene, 0, 1)), 0.02);
}

TEST(EstimateTwoView, ShowsAPureRotationByItsParallax) {
  for (const double relief_m : {0.0, 1.0}) {
    SceneOptions options = NoisyFacade(relief_m);
    options.spacing_m = 0.0;
    const Scene scene = MakeScene(options);
    const SceneMatches matches = MatchScene(scene, 0, 1);
    const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
    ASSERT_TRUE(result);
    EXPECT_LT(result->median_parallax_rad, 3.0 / kFocal_px);
    EXPECT_LT(result->cam2_from_cam1.rotation.angularDistance(RelativePose(scene, 0, 1).rotation),
              0.003);
    const auto num_true = std::count(matches.is_outlier.begin(), matches.is_outlier.end(), 0);
    EXPECT_GT(result->num_inliers, 0.9 * static_cast<double>(num_true));
  }
}

TEST(EstimateTwoView, MeasuresTheParallax) {
  SceneOptions options;
  options.relief_m = 0.0;
  options.spacing_m = 1.0;
  const SceneMatches matches = MatchScene(MakeScene(options), 0, 1);
  const auto result = EstimateTwoView(MakeOptions(2.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(result);
  // atan(1 m / 10 m) in the middle, less towards the edges.
  EXPECT_GT(result->median_parallax_rad, 0.07);
  EXPECT_LT(result->median_parallax_rad, 0.1);
}

TEST(EstimateTwoView, IsTheInverseWithTheViewsSwapped) {
  const SceneMatches matches = MatchScene(MakeScene(NoisyFacade(0.5)), 0, 1);
  const auto forward = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  const auto backward = EstimateTwoView(MakeOptions(3.0), matches.xy2, matches.xy1);
  ASSERT_TRUE(forward && backward);
  const Rigid3 inverse = backward->cam2_from_cam1.Inverse();
  // Both are optima of a symmetric error, over inliers that may differ by one or two.
  EXPECT_LT(inverse.rotation.angularDistance(forward->cam2_from_cam1.rotation), 5e-4);
  EXPECT_LT(DirectionAngle(inverse, forward->cam2_from_cam1), 5e-3);
}

TEST(EstimateTwoView, RepeatsItselfForASeed) {
  const SceneMatches matches = MatchScene(MakeScene(NoisyFacade(0.1)), 0, 1);
  const auto first = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  const auto second = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->cam2_from_cam1.Matrix(), second->cam2_from_cam1.Matrix());
  EXPECT_EQ(first->is_inlier, second->is_inlier);
}

TEST(EstimateTwoView, FindsNothingWithTooFewMatches) {
  EXPECT_FALSE(EstimateTwoView(MakeOptions(2.0), {}, {}));
  SceneMatches matches = MatchScene(MakeScene(), 0, 1);
  matches.xy1.resize(7);
  matches.xy2.resize(7);
  EXPECT_FALSE(EstimateTwoView(MakeOptions(2.0), matches.xy1, matches.xy2));
}

TEST(EstimateTwoView, ShowsNoParallaxInTheSamePhotoTwice) {
  const SceneMatches matches = MatchScene(MakeScene(), 0, 1);
  const auto result = EstimateTwoView(MakeOptions(2.0), matches.xy1, matches.xy1);
  ASSERT_TRUE(result);
  EXPECT_LT(result->median_parallax_rad, 1e-6);
}

TEST(EstimateTwoView, IsNeverSureOfOnePointOverAndOver) {
  const std::vector<Eigen::Vector2d> xy(50, {0.1, 0.2});
  const auto result = EstimateTwoView(MakeOptions(2.0), xy, xy);
  EXPECT_TRUE(!result || result->is_ambiguous);
}

TEST(EstimateTwoView, IsNotSureOfMatchesInOneCorner) {
  SceneOptions options;
  options.width_m = 0.4;
  options.height_m = 0.3;
  options.relief_m = 0.02;
  options.noise_px = 0.7;
  const SceneMatches matches = MatchScene(MakeScene(options), 0, 1);
  const auto result = EstimateTwoView(MakeOptions(3.0), matches.xy1, matches.xy2);
  EXPECT_TRUE(!result || result->is_ambiguous);
}

TEST(EstimateTwoView, RefusesBrokenPreconditions) {
  EXPECT_THROW(EstimateTwoView(MakeOptions(2.0), {{0.0, 0.0}}, {}), std::logic_error);
  EXPECT_THROW(EstimateTwoView(MakeOptions(-1.0), {}, {}), std::logic_error);
}

TEST(SampsonError, VanishesOnTrueMatchesAndIsTheDistanceToTheLineForATranslation) {
  const Scene scene = MakeScene();
  const SceneMatches matches = MatchScene(scene, 0, 1);
  const Eigen::Matrix3d essential = EssentialFromPose(RelativePose(scene, 0, 1));
  for (std::size_t i = 0; i < matches.xy1.size(); ++i) {
    EXPECT_LT(SampsonError(essential, matches.xy1[i], matches.xy2[i]), 1e-10);
  }
  // Moving sideways, epipolar lines are rows: a row error d is split evenly, d / sqrt(2).
  const Eigen::Matrix3d sideways =
      EssentialFromPose({Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0}});
  EXPECT_NEAR(
      SampsonError(sideways, {0.3, 0.1}, {0.2, 0.1 + 0.004}), 0.004 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(
      SampsonError(5.0 * sideways, {0.3, 0.1}, {0.2, 0.104}), 0.004 / std::sqrt(2.0), 1e-15);
}

}  // namespace
}  // namespace plumb
