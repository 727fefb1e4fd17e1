// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plumbline/geometry/triangulation.h"
#include "test/sfm/scene_photos.h"

namespace plumb {
namespace {

using test::MakeScene;
using test::Scene;
using test::SceneOptions;
using test::ScenePhoto;

// Features of two photos that show the same point.
std::vector<FeatureMatch> TrueMatches(const ScenePhoto& photo1, const ScenePhoto& photo2) {
  std::vector<FeatureMatch> matches;
  for (std::uint32_t i = 0; i < photo1.point_of_feature.size(); ++i) {
    const auto found = std::find(
        photo2.point_of_feature.begin(), photo2.point_of_feature.end(), photo1.point_of_feature[i]);
    if (found == photo2.point_of_feature.end()) continue;
    matches.push_back({i, static_cast<std::uint32_t>(found - photo2.point_of_feature.begin())});
  }
  return matches;
}

PairAttempt TryFirstTwo(const Scene& scene, const BootstrapOptions& options = {}) {
  const std::vector<ScenePhoto> photos = test::MakeScenePhotos(scene);
  const PhotoRecords records = test::MakeRecords(scene.camera, photos);
  return TryInitialPair(
      options, scene.camera, records.at({0}), records.at({1}), TrueMatches(photos[0], photos[1]));
}

SceneOptions NoisyFacade(double relief_m) {
  SceneOptions options;
  options.noise_px = 0.5;
  options.outlier_ratio = 0.1;
  options.relief_m = relief_m;
  return options;
}

double MedianDepthOfSharedPoints(const Scene& scene) {
  std::vector<double> depths;
  for (const int point : test::MatchScene(scene, 0, 1).point_idx) {
    const auto idx = static_cast<std::size_t>(point);
    depths.push_back((scene.cams_from_map[0] * scene.points_in_map[idx]).z());
  }
  std::nth_element(depths.begin(),
                   depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2),
                   depths.end());
  return depths[depths.size() / 2];
}

TEST(TryInitialPair, FindsThePoseOfPlanarAndOfDeepScenes) {
  for (const double relief_m : {0.0, 0.05, 0.3, 1.0, 3.0}) {
    const Scene scene = MakeScene(NoisyFacade(relief_m));
    const PairAttempt attempt = TryFirstTwo(scene);
    ASSERT_TRUE(attempt.pair) << "relief " << relief_m << " m: " << ToString(attempt.reason);
    const Rigid3 truth = test::RelativePose(scene, 0, 1);
    const Rigid3& found = attempt.pair->cam2_from_cam1;
    EXPECT_LT(found.rotation.angularDistance(truth.rotation), 0.005) << relief_m;
    const double cosine = found.translation.normalized().dot(truth.translation.normalized());
    EXPECT_GT(cosine, std::cos(0.03)) << relief_m;
  }
}

TEST(TryInitialPair, ScalesThePairToTheMedianDepth) {
  SceneOptions options;
  options.distance_m = 23.0;
  options.spacing_m = 3.0;
  const Scene scene = MakeScene(options);
  const PairAttempt attempt = TryFirstTwo(scene);
  ASSERT_TRUE(attempt.pair);
  const double scale = kInitialMedianDepth / MedianDepthOfSharedPoints(scene);
  const Eigen::Vector3d expected = scale * test::RelativePose(scene, 0, 1).translation;
  EXPECT_LT((attempt.pair->cam2_from_cam1.translation - expected).norm(), 1e-3);
}

TEST(TryInitialPair, CountsTheMatchesThatAgree) {
  const Scene scene = MakeScene(NoisyFacade(1.0));
  const PairAttempt attempt = TryFirstTwo(scene);
  ASSERT_TRUE(attempt.pair);
  const std::vector<char> is_outlier = test::MatchScene(scene, 0, 1).is_outlier;
  const auto num_true = std::count(is_outlier.begin(), is_outlier.end(), 0);
  EXPECT_GT(attempt.pair->num_inliers, 0.95 * static_cast<double>(num_true));
  EXPECT_LT(attempt.pair->num_inliers, 1.05 * static_cast<double>(num_true));
  EXPECT_EQ(attempt.pair->photo1, PhotoId{0});
  EXPECT_EQ(attempt.pair->photo2, PhotoId{1});
}

TEST(TryInitialPair, OfPureRotationHasNoParallax) {
  for (const double relief_m : {0.0, 1.0}) {
    SceneOptions options = NoisyFacade(relief_m);
    options.spacing_m = 0.0;
    const PairAttempt attempt = TryFirstTwo(MakeScene(options));
    EXPECT_FALSE(attempt.pair);
    EXPECT_EQ(attempt.reason, RefusalReason::kNoParallax) << "relief " << relief_m << " m";
  }
}

TEST(TryInitialPair, OfTooFewMatchesHasNoOverlap) {
  SceneOptions options;
  options.num_points = 60;
  const PairAttempt attempt = TryFirstTwo(MakeScene(options));
  EXPECT_FALSE(attempt.pair);
  EXPECT_EQ(attempt.reason, RefusalReason::kNoOverlap);
}

TEST(TryInitialPair, OfMatchesThatDisagreeHasTooFewInliers) {
  SceneOptions options;
  options.outlier_ratio = 0.9;
  const PairAttempt attempt = TryFirstTwo(MakeScene(options));
  EXPECT_FALSE(attempt.pair);
  EXPECT_EQ(attempt.reason, RefusalReason::kTooFewInliers);
}

TEST(TryInitialPair, ScoreGrowsWithParallaxUntilItIsGood) {
  double last_score = 0.0;
  double last_parallax_deg = 0.0;
  for (const double spacing_m : {0.45, 0.6, 0.9}) {  // 2.6, 3.4 and 5.2 degrees.
    SceneOptions options;
    options.max_turn_rad = 0.0;
    options.spacing_m = spacing_m;
    const PairAttempt attempt = TryFirstTwo(MakeScene(options));
    ASSERT_TRUE(attempt.pair) << spacing_m << ": " << ToString(attempt.reason);
    EXPECT_GT(attempt.pair->parallax_deg, last_parallax_deg);
    EXPECT_GT(attempt.pair->score, 1.2 * last_score);
    last_score = attempt.pair->score;
    last_parallax_deg = attempt.pair->parallax_deg;
  }
  SceneOptions options;
  options.spacing_m = 2.0;
  const PairAttempt good = TryFirstTwo(MakeScene(options));
  ASSERT_TRUE(good.pair);
  EXPECT_EQ(good.pair->score, good.pair->num_inliers);
}

TEST(TryInitialPair, IsTheSameEachTime) {
  const Scene scene = MakeScene(NoisyFacade(0.3));
  const PairAttempt first = TryFirstTwo(scene);
  const PairAttempt second = TryFirstTwo(scene);
  ASSERT_TRUE(first.pair && second.pair);
  EXPECT_EQ(first.pair->cam2_from_cam1.translation, second.pair->cam2_from_cam1.translation);
  EXPECT_EQ(first.pair->score, second.pair->score);
}

TEST(FirstCameraFromMap, LooksAlongYWithZUp) {
  const Rigid3 cam_from_map = FirstCameraFromMap();
  EXPECT_LT((cam_from_map * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((cam_from_map * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace plumb
