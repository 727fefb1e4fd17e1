// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/localizer.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "test/sfm/scene_photos.h"

namespace plumb {
namespace {

using Status = Localization::Status;
using test::MakeScene;
using test::Random;
using test::Scene;
using test::SceneOptions;
using test::ScenePhoto;

// A map with these landmarks; landmark i is that of point i. Two views at the origin carry
// their tracks.
Map MakeLandmarkMap(const std::vector<Eigen::Vector3d>& points_in_map) {
  FeatureSet features;
  features.features.resize(points_in_map.size());
  features.colors.resize(points_in_map.size());
  features.descriptors.setZero(static_cast<Eigen::Index>(points_in_map.size()), kDescriptorSize);
  const auto shared = std::make_shared<const FeatureSet>(features);
  Map map;
  for (const std::uint32_t photo : {0U, 1U}) {
    map.AddView({photo}, {"", Timestamp{}, Rigid3(), shared, {}, 0});
  }
  for (std::uint32_t i = 0; i < points_in_map.size(); ++i) {
    map.AddLandmark(points_in_map[i], {{{0}, i}, {{1}, i}});
  }
  return map;
}

double CenterDistance(const Rigid3& a, const Rigid3& b) {
  return (a.TargetOriginInSource() - b.TargetOriginInSource()).norm();
}

// One photo of a scene, and its true matches.
struct Case {
  Scene scene;
  Map map;
  PhotoRecord photo;
  std::vector<MapMatch> matches;

  const Rigid3& truth() const { return scene.cams_from_map[0]; }
  Localization Localize(const LocalizerOptions& options = {}) const {
    return LocalizePhoto(options, scene.camera, map, photo, matches);
  }
};

SceneOptions OnePhoto(double noise_px = 0.0, double outlier_ratio = 0.0) {
  SceneOptions options;
  options.num_cameras = 1;
  options.noise_px = noise_px;
  options.outlier_ratio = outlier_ratio;
  return options;
}

Case MakeCase(const SceneOptions& options) {
  const Scene scene = MakeScene(options);
  const std::vector<ScenePhoto> photos = test::MakeScenePhotos(scene);
  Case made{scene,
            MakeLandmarkMap(scene.points_in_map),
            MakePhotoRecord(scene.camera, {7}, "photo", Timestamp{}, photos[0].features),
            {}};
  for (std::uint32_t i = 0; i < photos[0].point_of_feature.size(); ++i) {
    made.matches.push_back({i, {static_cast<std::uint32_t>(photos[0].point_of_feature[i])}});
  }
  return made;
}

TEST(LocalizePhoto, FindsTheNoiseFreePose) {
  SceneOptions options = OnePhoto();
  options.camera = test::MakeCamera(-0.1, 0.03, 0.001, -0.0005);
  const Case made = MakeCase(options);
  const Localization found = made.Localize();
  ASSERT_EQ(found.status, Status::kOk);
  EXPECT_LT(CenterDistance(found.cam_from_map, made.truth()), 1e-5);  // Pixels are float.
  EXPECT_LT(found.cam_from_map.rotation.angularDistance(made.truth().rotation), 1e-6);
  EXPECT_EQ(found.inliers.size(), made.matches.size());
  EXPECT_EQ(found.num_matches, static_cast<int>(made.matches.size()));
  EXPECT_LT(found.median_error_px, 0.01);
}

TEST(LocalizePhoto, BearsNoiseAndSixtyPercentOutliers) {
  for (int seed = 1; seed <= 5; ++seed) {
    SceneOptions options = OnePhoto(0.5, 0.6);
    options.random_seed = seed;
    const Case made = MakeCase(options);
    const Localization found = made.Localize();
    ASSERT_EQ(found.status, Status::kOk) << "seed " << seed;
    EXPECT_LT(CenterDistance(found.cam_from_map, made.truth()), 0.01) << "seed " << seed;
    EXPECT_LT(found.cam_from_map.rotation.angularDistance(made.truth().rotation), 0.001);
    EXPECT_NEAR(found.median_error_px, 0.5 * 1.18, 0.2);  // Median of Rayleigh's distribution.
  }
}

TEST(LocalizePhoto, GivesEachFeatureAndEachLandmarkOnce) {
  Case made = MakeCase(OnePhoto(0.5));
  const std::size_t num_true = made.matches.size();
  for (std::size_t i = 0; i + 1 < num_true; i += 2) {
    made.matches.push_back({made.matches[i].feature_idx, made.matches[i + 1].landmark});
    made.matches.push_back(made.matches[i]);
  }
  const Localization found = made.Localize();
  ASSERT_EQ(found.status, Status::kOk);
  std::set<std::uint32_t> features;
  std::set<LandmarkId> landmarks;
  for (const MapMatch& inlier : found.inliers) {
    EXPECT_TRUE(features.insert(inlier.feature_idx).second);
    EXPECT_TRUE(landmarks.insert(inlier.landmark).second);
  }
  EXPECT_GT(found.inliers.size(), num_true * 95 / 100);
}

TEST(LocalizePhoto, RefusesTooFewMatches) {
  Case made = MakeCase(OnePhoto());
  made.matches.resize(29);
  const Localization found = made.Localize();
  EXPECT_EQ(found.status, Status::kTooFewMatches);
  EXPECT_EQ(found.num_matches, 29);
  EXPECT_TRUE(found.inliers.empty());
}

TEST(LocalizePhoto, RefusesMatchesThatDoNotAgree) {
  const Case made = MakeCase(OnePhoto(0.5, 0.97));
  EXPECT_EQ(made.Localize().status, Status::kTooFewInliers);
}

TEST(LocalizePhoto, RefusesMatchesOfAnotherPlace) {
  Case made = MakeCase(OnePhoto(0.5));
  Random random(9);
  for (MapMatch& match : made.matches) {
    match.landmark.value = static_cast<std::uint32_t>(random.Index(500));
  }
  EXPECT_EQ(made.Localize().status, Status::kTooFewInliers);
}

TEST(LocalizePhoto, RefusesInliersInOneCorner) {
  SceneOptions options = OnePhoto();
  options.num_points = 4000;
  Case made = MakeCase(options);
  std::vector<MapMatch> in_corner;
  for (const MapMatch& match : made.matches) {  // Four cells of the grid.
    const Eigen::Vector2d pixel = made.photo.features->features[match.feature_idx].Pixel();
    if (pixel.x() < 990.0 && pixel.y() < 740.0) in_corner.push_back(match);
  }
  made.matches = in_corner;
  ASSERT_GE(made.matches.size(), 60U);
  EXPECT_EQ(made.Localize().status, Status::kTooFewInliers);
}

// Repeated windows: beside the landmarks stand others that look the same, `shift_m` along the
// facade, and `share` of the matches are with those.
Case MakeRepeatedFacade(double shift_m, double share) {
  Case made = MakeCase(OnePhoto(0.5));
  const auto num_points = static_cast<std::uint32_t>(made.scene.points_in_map.size());
  std::vector<Eigen::Vector3d> points = made.scene.points_in_map;
  for (std::uint32_t i = 0; i < num_points; ++i) {
    points.push_back(points[i] + Eigen::Vector3d(shift_m, 0.0, 0.0));
  }
  made.map = MakeLandmarkMap(points);
  Random random(21);
  for (MapMatch& match : made.matches) {
    if (random.Uniform(0.0, 1.0) < share) match.landmark.value += num_points;
  }
  return made;
}

TEST(LocalizePhoto, IsAmbiguousWhereTwoWindowsFitEqually) {
  EXPECT_EQ(MakeRepeatedFacade(3.0, 0.5).Localize().status, Status::kAmbiguous);
  EXPECT_EQ(MakeRepeatedFacade(-3.0, 0.4).Localize().status, Status::kAmbiguous);
}

TEST(LocalizePhoto, IsAmbiguousWhereEachFeatureFitsTwoWindows) {
  Case made = MakeRepeatedFacade(3.0, 0.0);
  const std::size_t num_true = made.matches.size();
  for (std::size_t i = 0; i < num_true; ++i) {
    const auto num_points = static_cast<std::uint32_t>(made.scene.points_in_map.size());
    made.matches.push_back(
        {made.matches[i].feature_idx, {made.matches[i].landmark.value + num_points}});
  }
  EXPECT_EQ(made.Localize().status, Status::kAmbiguous);
}

TEST(LocalizePhoto, BelievesEightyPercentAgainstTwenty) {
  const Case made = MakeRepeatedFacade(3.0, 0.2);
  const Localization found = made.Localize();
  ASSERT_EQ(found.status, Status::kOk);
  EXPECT_LT(CenterDistance(found.cam_from_map, made.truth()), 0.01);
}

TEST(LocalizePhoto, TakesASecondPoseCloseToTheFirstForTheSamePlace) {
  // 0.3 m are 75 pixels, far beyond the bound on the error, and a thirtieth of the distance.
  const Case made = MakeRepeatedFacade(0.3, 0.4);
  const Localization found = made.Localize();
  ASSERT_EQ(found.status, Status::kOk);
  EXPECT_LT(CenterDistance(found.cam_from_map, made.truth()), 0.01);
}

TEST(LocalizePhoto, IsTheSameEachTime) {
  const Case made = MakeCase(OnePhoto(0.5, 0.6));
  const Localization first = made.Localize();
  const Localization second = made.Localize();
  EXPECT_EQ(first.cam_from_map.translation, second.cam_from_map.translation);
  EXPECT_EQ(first.inliers.size(), second.inliers.size());
}

// Two photos in the map, a third one located by some of its matches.
class GuidedMatchingTest : public testing::Test {
 protected:
  void SetUp() override {
    SceneOptions options;
    options.num_cameras = 3;
    options.noise_px = 0.5;
    options.num_points = 400;
    scene_ = MakeScene(options);
    photos_ = test::MakeScenePhotos(scene_);
    map_ = test::MakeTrueMap(scene_, {photos_[0], photos_[1]});
    localization_.status = Status::kOk;
    localization_.cam_from_map = scene_.cams_from_map[2];
    landmark_of_point_.resize(scene_.points_in_map.size());
    for (const LandmarkId id : map_.LandmarkIds()) {
      const Observation& first = map_.landmark(id).track[0];
      const int point = photos_[first.photo.value].point_of_feature[first.feature_idx];
      landmark_of_point_[static_cast<std::size_t>(point)] = id;
    }
  }

  LandmarkId TruthOf(std::uint32_t feature_idx) const {
    return landmark_of_point_[static_cast<std::size_t>(photos_[2].point_of_feature[feature_idx])];
  }

  int NumInView() const {
    int number = 0;
    for (std::uint32_t i = 0; i < photos_[2].point_of_feature.size(); ++i) {
      number += TruthOf(i).IsValid() ? 1 : 0;
    }
    return number;
  }

  void Extend() {
    const PhotoRecord photo =
        MakePhotoRecord(scene_.camera, {2}, "photo2", Timestamp{}, photos_[2].features);
    ExtendByGuidedMatching({}, scene_.camera, map_, photo, {{0}, {1}}, &localization_);
  }

  Scene scene_{test::MakeCamera(), {}, {}, {}};
  std::vector<ScenePhoto> photos_;
  Map map_;
  Localization localization_;
  std::vector<LandmarkId> landmark_of_point_;
};

TEST_F(GuidedMatchingTest, AddsLandmarksThatHadNoMatch) {
  for (std::uint32_t i = 0; localization_.inliers.size() < 40; ++i) {
    if (TruthOf(i).IsValid()) localization_.inliers.push_back({i, TruthOf(i)});
  }
  Extend();
  EXPECT_EQ(localization_.status, Status::kOk);
  EXPECT_GT(static_cast<int>(localization_.inliers.size()), NumInView() * 95 / 100);
  for (const MapMatch& inlier : localization_.inliers) {
    EXPECT_EQ(inlier.landmark, TruthOf(inlier.feature_idx));
  }
  EXPECT_LT(CenterDistance(localization_.cam_from_map, scene_.cams_from_map[2]), 0.01);
}

TEST_F(GuidedMatchingTest, LeavesOutWhatLooksDifferent) {
  photos_[2].features.descriptors =
      RandomDescriptors(static_cast<int>(photos_[2].features.size()), /*seed=*/99);
  for (std::uint32_t i = 0; localization_.inliers.size() < 40; ++i) {
    if (TruthOf(i).IsValid()) localization_.inliers.push_back({i, TruthOf(i)});
  }
  Extend();
  EXPECT_LE(localization_.inliers.size(), 40U);
  EXPECT_GE(localization_.inliers.size(), 38U);
}

TEST_F(GuidedMatchingTest, LeavesOutWhatLiesElsewhere) {
  Extend();
  EXPECT_GT(localization_.inliers.size(), 100U);
  localization_.inliers.clear();
  localization_.cam_from_map = scene_.cams_from_map[2];
  for (Feature& feature : photos_[2].features.features) feature.x_px += 30.0F;
  Extend();
  EXPECT_TRUE(localization_.inliers.empty());
}

TEST_F(GuidedMatchingTest, LeavesOutWhatIsOfAnotherSize) {
  for (Feature& feature : photos_[2].features.features) feature.scale_px *= 2.0F;
  Extend();
  EXPECT_TRUE(localization_.inliers.empty());
}

}  // namespace
}  // namespace plumb
