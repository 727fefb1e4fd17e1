// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/expander.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "test/sfm/map_invariants.h"
#include "test/sfm/scene_photos.h"

namespace plumb {
namespace {

using test::MakeScene;
using test::Scene;
using test::SceneOptions;
using test::ScenePhoto;

SceneOptions FourPhotos() {
  SceneOptions options;
  options.num_points = 300;
  options.num_cameras = 4;
  options.noise_px = 0.3;
  return options;
}

// Photos of a scene at their true places, matched by their descriptors.
class ExpanderTest : public testing::Test {
 protected:
  void Use(const SceneOptions& options) {
    scene_ = MakeScene(options);
    photos_ = test::MakeScenePhotos(scene_);
  }

  void MatchAll() {
    records_ = test::MakeRecords(scene_.camera, photos_);
    for (std::uint32_t i = 0; i < photos_.size(); ++i) {
      for (std::uint32_t j = i + 1; j < photos_.size(); ++j) {
        matches_.Match(records_.at({j}), records_.at({i}));
      }
    }
  }

  void AddView(std::uint32_t photo) {
    test::AddViewAt(records_, {photo}, scene_.cams_from_map[photo], &map_);
  }

  ExpansionReport Expand(std::uint32_t photo) {
    return ExpandMap(options_, scene_.camera, matches_, records_, {photo}, &map_);
  }

  ExpansionReport Complete() {
    return CompleteTracks(options_, scene_.camera, matches_, map_.LandmarkIds(), &map_);
  }

  int Cull() { return CullLandmarks(options_, scene_.camera, map_.LandmarkIds(), &map_); }

  int PointOf(const Observation& observation) const {
    return photos_[observation.photo.value].point_of_feature[observation.feature_idx];
  }

  int NumSeenBy(std::size_t least_photos) const {
    std::map<int, std::size_t> counts;
    for (const ScenePhoto& photo : photos_) {
      for (const int point : photo.point_of_feature) ++counts[point];
    }
    int number = 0;
    for (const auto& [point, count] : counts) number += count >= least_photos ? 1 : 0;
    return number;
  }

  // Of landmarks whose observations show one point.
  void ExpectPureTracks() const {
    for (const LandmarkId id : map_.LandmarkIds()) {
      const Landmark& landmark = map_.landmark(id);
      for (const Observation& observation : landmark.track) {
        ASSERT_EQ(PointOf(observation), PointOf(landmark.track[0])) << "landmark " << id.value;
      }
    }
  }

  ExpanderOptions options_;
  Scene scene_{test::MakeCamera(), {}, {}, {}};
  std::vector<ScenePhoto> photos_;
  PhotoRecords records_;
  MatchGraph matches_{MatcherOptions()};
  Map map_;
};

TEST_F(ExpanderTest, TriangulatesWhatTwoPhotosMatch) {
  SceneOptions options = FourPhotos();
  options.num_cameras = 2;
  options.noise_px = 0.0;
  options.camera = test::MakeCamera(-0.1, 0.03, 0.001, -0.0005);
  Use(options);
  MatchAll();
  AddView(0);
  AddView(1);
  const ExpansionReport report = Expand(1);
  EXPECT_EQ(report.num_new_landmarks, NumSeenBy(2));
  EXPECT_EQ(static_cast<int>(map_.num_landmarks()), NumSeenBy(2));
  for (const LandmarkId id : map_.LandmarkIds()) {
    const Landmark& landmark = map_.landmark(id);
    const auto point = static_cast<std::size_t>(PointOf(landmark.track[0]));
    EXPECT_LT((landmark.position_in_map - scene_.points_in_map[point]).norm(), 1e-4);
  }
  ExpectPureTracks();
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(ExpanderTest, ContinuesTracksIntoNewViews) {
  Use(FourPhotos());
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) {
    AddView(photo);
    const ExpansionReport report = Expand(photo);
    EXPECT_GE(report.num_new_observations, photo >= 2 ? 100 : 0) << "photo " << photo;
  }
  std::size_t num_observations = 0;
  for (const ScenePhoto& photo : photos_) num_observations += photo.point_of_feature.size();
  EXPECT_GE(static_cast<int>(map_.num_landmarks()), NumSeenBy(2) * 98 / 100);
  EXPECT_LE(static_cast<int>(map_.num_landmarks()), NumSeenBy(2));
  EXPECT_GE(map_.num_observations(), num_observations * 95 / 100);
  ExpectPureTracks();
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(ExpanderTest, ExpandingTwiceAddsNothing) {
  Use(FourPhotos());
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) AddView(photo);
  for (std::uint32_t photo = 0; photo < 4; ++photo) Expand(photo);
  const std::size_t num_observations = map_.num_observations();
  for (std::uint32_t photo = 0; photo < 4; ++photo) {
    EXPECT_EQ(Expand(photo).num_new_landmarks, 0);
  }
  EXPECT_EQ(map_.num_observations(), num_observations);
}

TEST_F(ExpanderTest, LeavesOutMatchesOffTheirEpipolarLines) {
  Use(FourPhotos());
  // In photo 3 the looks of neighbouring features are exchanged: all its matches are wrong.
  DescriptorMatrix& descriptors = photos_[3].features.descriptors;
  for (Eigen::Index i = 0; i + 1 < descriptors.rows(); i += 2) {
    descriptors.row(i).swap(descriptors.row(i + 1));
  }
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) {
    AddView(photo);
    Expand(photo);
  }
  // Features that chance put on the line of another's match may stay: about 8 of 3000 pixels.
  EXPECT_LT(map_.view({3}).num_observations, 6);
  EXPECT_GT(map_.view({2}).num_observations, 150);
}

TEST_F(ExpanderTest, LeavesOutPointsWithoutParallax) {
  SceneOptions options = FourPhotos();
  options.spacing_m = 0.02;
  Use(options);
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) {
    AddView(photo);
    Expand(photo);
  }
  EXPECT_EQ(map_.num_landmarks(), 0U);
}

TEST_F(ExpanderTest, IgnoresPhotosThatAreNotInTheMap) {
  Use(FourPhotos());
  MatchAll();
  AddView(0);
  Expand(0);
  EXPECT_EQ(map_.num_landmarks(), 0U);
  AddView(2);
  Expand(2);
  EXPECT_GT(map_.num_landmarks(), 100U);
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

// Photos 0 and 1 hold one landmark of each point, photos 2 and 3 another.
class SplitTracksTest : public ExpanderTest {
 protected:
  void SetUp() override {
    Use(FourPhotos());
    MatchAll();
    for (std::uint32_t photo = 0; photo < 4; ++photo) AddView(photo);
    test::AddTrueLandmarks(scene_, photos_, {0, 1}, &map_);
    num_first_ = static_cast<int>(map_.num_landmarks());
    test::AddTrueLandmarks(scene_, photos_, {2, 3}, &map_);
    for (const LandmarkId id : map_.LandmarkIds()) {
      points_.insert(PointOf(map_.landmark(id).track[0]));
    }
    ASSERT_GT(map_.num_landmarks(), points_.size() + 100);
  }

  int num_first_ = 0;
  std::set<int> points_;
};

TEST_F(SplitTracksTest, CompletingMergesTheTracksOfOnePoint) {
  const auto num_twice = static_cast<int>(map_.num_landmarks() - points_.size());
  const ExpansionReport report = Complete();
  EXPECT_EQ(report.num_merged, num_twice);
  EXPECT_EQ(map_.num_landmarks(), points_.size());
  ExpectPureTracks();
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(SplitTracksTest, ExpandingMergesTheTracksOfOnePoint) {
  EXPECT_GT(Expand(3).num_merged, 100);
  ExpectPureTracks();
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(SplitTracksTest, TracksThatLieApartAreNotMerged) {
  const std::size_t num_landmarks = map_.num_landmarks();
  for (const LandmarkId id : map_.LandmarkIds()) {
    if (static_cast<int>(id.value) < num_first_) continue;
    const Eigen::Vector3d& position = map_.landmark(id).position_in_map;
    map_.MoveLandmark(id, position + Eigen::Vector3d(0.1, 0.0, 0.0));  // 25 px in every view.
  }
  EXPECT_EQ(Complete().num_merged, 0);
  EXPECT_EQ(map_.num_landmarks(), num_landmarks);
}

TEST_F(ExpanderTest, CompletingAddsTheFreeFeaturesThatFit) {
  Use(FourPhotos());
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) AddView(photo);
  test::AddTrueLandmarks(scene_, photos_, {0, 1}, &map_);
  const std::size_t num_before = map_.num_observations();
  const std::size_t num_landmarks = map_.num_landmarks();
  const ExpansionReport report = Complete();
  EXPECT_GT(report.num_new_observations, 200);
  EXPECT_EQ(map_.num_observations(),
            num_before + static_cast<std::size_t>(report.num_new_observations));
  EXPECT_EQ(map_.num_landmarks(), num_landmarks);
  ExpectPureTracks();
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(ExpanderTest, CullsWhatIsFarFromItsProjection) {
  Use(FourPhotos());
  map_ = test::MakeTrueMap(scene_, photos_);
  EXPECT_EQ(Cull(), 0);
  const std::vector<LandmarkId> ids = map_.LandmarkIds();
  const Landmark gone = map_.landmark(ids[3]);
  map_.MoveLandmark(ids[3], gone.position_in_map + Eigen::Vector3d(0.2, 0.0, 0.0));
  EXPECT_EQ(Cull(), static_cast<int>(gone.track.size()));
  EXPECT_FALSE(map_.HasLandmark(ids[3]));
  EXPECT_EQ(map_.num_landmarks(), ids.size() - 1);
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(ExpanderTest, CullsTheObservationsOfAViewThatIsWrong) {
  Use(FourPhotos());
  map_ = test::MakeTrueMap(scene_, photos_);
  const Rigid3 aside(Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0});
  map_.MoveView({3}, aside * scene_.cams_from_map[3]);
  const int num_observations = map_.view({3}).num_observations;
  EXPECT_GE(Cull(), num_observations);
  EXPECT_EQ(map_.view({3}).num_observations, 0);
  EXPECT_GT(map_.view({0}).num_observations, 150);
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(ExpanderTest, CullsLandmarksBehindACamera) {
  Use(FourPhotos());
  map_ = test::MakeTrueMap(scene_, photos_);
  const LandmarkId id = map_.LandmarkIds()[5];
  map_.MoveLandmark(id, {0.0, -50.0, 0.0});
  Cull();
  EXPECT_FALSE(map_.HasLandmark(id));
}

TEST_F(ExpanderTest, CullsLandmarksWithoutParallax) {
  SceneOptions options = FourPhotos();
  options.spacing_m = 0.05;
  Use(options);
  map_ = test::MakeTrueMap(scene_, photos_);
  ASSERT_GT(map_.num_landmarks(), 100U);
  Cull();
  EXPECT_EQ(map_.num_landmarks(), 0U);
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

// A second feature at the spot of each, of another orientation and so of other looks.
ScenePhoto WithSecondOrientations(const ScenePhoto& photo, const ScenePhoto& looks) {
  ScenePhoto doubled;
  doubled.features.descriptors.resize(2 * photo.features.descriptors.rows(), kDescriptorSize);
  for (std::size_t i = 0; i < photo.features.size(); ++i) {
    for (const ScenePhoto* source : {&photo, &looks}) {
      const auto row = static_cast<Eigen::Index>(doubled.features.size());
      Feature feature = photo.features.features[i];
      feature.orientation_rad = source == &photo ? 0.0F : 2.0F;
      doubled.features.features.push_back(feature);
      doubled.features.colors.push_back(photo.features.colors[i]);
      doubled.features.descriptors.row(row) =
          source->features.descriptors.row(static_cast<Eigen::Index>(i));
      doubled.point_of_feature.push_back(photo.point_of_feature[i]);
    }
  }
  return doubled;
}

TEST_F(ExpanderTest, ASpotOfSeveralOrientationsIsOneLandmark) {
  Use(FourPhotos());
  const std::vector<ScenePhoto> other_looks = test::MakeScenePhotos(scene_, /*seed=*/9);
  for (std::size_t i = 0; i < photos_.size(); ++i) {
    photos_[i] = WithSecondOrientations(photos_[i], other_looks[i]);
  }
  MatchAll();
  for (std::uint32_t photo = 0; photo < 4; ++photo) {
    AddView(photo);
    Expand(photo);
  }
  Complete();
  EXPECT_GT(map_.num_landmarks(), 100U);
  std::set<int> points;
  for (const LandmarkId id : map_.LandmarkIds()) {
    EXPECT_TRUE(points.insert(PointOf(map_.landmark(id).track[0])).second);
  }
  ExpectPureTracks();
}

TEST_F(ExpanderTest, AWidenedPairCountsWithItsLessDistinctMatches) {
  Use(FourPhotos());
  // Features of little distinction: half-way between their point's looks and another's.
  DescriptorMatrix& descriptors = photos_[1].features.descriptors;
  for (Eigen::Index i = 0; i + 1 < descriptors.rows(); i += 2) {
    for (Eigen::Index k = 0; k < kDescriptorSize; ++k) {
      descriptors(i, k) =
          static_cast<std::uint8_t>((11 * descriptors(i, k) + 9 * descriptors(i + 1, k)) / 20);
    }
  }
  records_ = test::MakeRecords(scene_.camera, photos_);
  const PhotoRecord& first = records_.at({0});
  const PhotoRecord& second = records_.at({1});
  const std::size_t num_distinct = matches_.Match(second, first).size();
  const std::vector<FeatureMatch> all = matches_.MatchWidely(second, first);
  ASSERT_GT(all.size(), num_distinct + 20);
  const auto weak = std::find_if(
      all.begin(), all.end(), [](const FeatureMatch& match) { return !match.is_distinct; });
  const auto is_known = [&] {
    const std::vector<Observation>& others = matches_.MatchesOf({{0}, weak->idx2});
    return std::count(others.begin(), others.end(), Observation{{1}, weak->idx1});
  };
  EXPECT_EQ(is_known(), 0);
  matches_.Widen({0}, {1});
  matches_.Widen({1}, {0});
  EXPECT_EQ(is_known(), 1);
  EXPECT_EQ(matches_.Match(second, first).size(), all.size());
  EXPECT_EQ(matches_.Match(first, second).size(), all.size());
}

TEST_F(ExpanderTest, MatchesAPairOnceInEitherDirection) {
  Use(FourPhotos());
  records_ = test::MakeRecords(scene_.camera, photos_);
  const std::vector<FeatureMatch> forward = matches_.Match(records_.at({0}), records_.at({1}));
  const std::vector<FeatureMatch> backward = matches_.Match(records_.at({1}), records_.at({0}));
  ASSERT_GT(forward.size(), 100U);
  ASSERT_EQ(forward.size(), backward.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const FeatureMatch& match : forward) pairs.insert({match.idx1, match.idx2});
  for (const FeatureMatch& match : backward) {
    EXPECT_EQ(pairs.count({match.idx2, match.idx1}), 1U);
    const std::vector<Observation>& others = matches_.MatchesOf({{1}, match.idx1});
    ASSERT_EQ(others.size(), 1U);
    EXPECT_EQ(others[0], (Observation{{0}, match.idx2}));
  }
}

}  // namespace
}  // namespace plumb
