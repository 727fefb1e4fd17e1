// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bundle_problem.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// A map of the first `num_views` photos of a row; more can be added.
class BundleProblemTest : public testing::Test {
 protected:
  void MakeMap(std::uint32_t num_views) {
    for (std::uint32_t i = 0; i < num_views; ++i) AddView(i);
    AddLandmarks();
  }

  void AddView(std::uint32_t photo) {
    test::AddViewAt(records_, {photo}, scene_.cams_from_map[photo], &map_);
    ids_.push_back(photo);
  }

  void AddLandmarks() { test::AddTrueLandmarks(scene_, photos_, ids_, &map_); }

  static SceneOptions RowOfEight() {
    SceneOptions options;
    options.num_points = 300;
    options.num_cameras = 8;
    options.width_m = 50.0;
    options.spacing_m = 6.0;  // A photo shares points with its two neighbours on either side.
    return options;
  }

  Scene scene_ = MakeScene(RowOfEight());
  std::vector<ScenePhoto> photos_ = test::MakeScenePhotos(scene_);
  PhotoRecords records_ = test::MakeRecords(scene_.camera, photos_);
  std::vector<std::uint32_t> ids_;
  Map map_;
};

BundleProblem Moved(BundleProblem problem, const Rigid3& map_from_map) {
  for (BundleView& view : problem.views) {
    view.cam_from_map = view.cam_from_map * map_from_map.Inverse();
  }
  for (BundleLandmark& landmark : problem.landmarks) {
    landmark.position_in_map = map_from_map * landmark.position_in_map;
  }
  return problem;
}

void ExpectMovedBy(const Rigid3& map_from_map, const Map& before, const Map& after) {
  ASSERT_EQ(after.views().size(), before.views().size());
  for (const auto& [photo, view] : before.views()) {
    const Rigid3 expected = view.cam_from_map * map_from_map.Inverse();
    const Rigid3& actual = after.view(photo).cam_from_map;
    EXPECT_LT((actual.translation - expected.translation).norm(), 1e-9) << view.name;
    EXPECT_LT(actual.rotation.angularDistance(expected.rotation), 1e-7) << view.name;
  }
  ASSERT_EQ(after.num_landmarks(), before.num_landmarks());
  for (const LandmarkId id : before.LandmarkIds()) {
    const Eigen::Vector3d expected = map_from_map * before.landmark(id).position_in_map;
    ASSERT_LT((after.landmark(id).position_in_map - expected).norm(), 1e-9) << id.value;
  }
}

const Rigid3 kMotion{Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3), {3.0, -2.0, 1.0}};

TEST_F(BundleProblemTest, CarriesLaterViewsAndLandmarksByTheMotionOfAll) {
  MakeMap(4);
  const BundleProblem before = MakeGlobalBundle({}, map_, scene_.camera.lens());
  for (const std::uint32_t photo : {4U, 5U, 6U}) AddView(photo);
  AddLandmarks();
  ASSERT_GT(map_.num_landmarks(), before.landmarks.size());
  const Map grown = map_;
  ApplyStaleBundle(before, Moved(before, kMotion), &map_);
  ExpectMovedBy(kMotion, grown, map_);
}

TEST_F(BundleProblemTest, CarriesAViewThatHangsOnALaterOneOfGreaterId) {
  MakeMap(2);
  const BundleProblem before = MakeGlobalBundle({}, map_, scene_.camera.lens());
  // Photo 4 came first and was refused until 7 had been located; both after the bundle began.
  std::swap(scene_.cams_from_map[4], scene_.cams_from_map[7]);
  std::swap(scene_.observations[4], scene_.observations[7]);
  photos_ = test::MakeScenePhotos(scene_);
  records_ = test::MakeRecords(scene_.camera, photos_);
  // Places from left to right: 0, 1, 2, 3, 7, 5, 6, 4.
  for (const std::uint32_t photo : {7U, 5U, 6U, 4U, 2U, 3U}) AddView(photo);
  AddLandmarks();
  const Map grown = map_;
  ApplyStaleBundle(before, Moved(before, kMotion), &map_);
  ExpectMovedBy(kMotion, grown, map_);
}

TEST_F(BundleProblemTest, PassesOverWhatHasGoneSince) {
  MakeMap(5);
  const BundleProblem before = MakeGlobalBundle({}, map_, scene_.camera.lens());
  map_.RemoveView({0});
  map_.RemoveLandmark(map_.LandmarkIds().front());
  map_.RemoveLandmark(map_.LandmarkIds().back());
  const Map shrunk = map_;
  ApplyStaleBundle(before, Moved(before, kMotion), &map_);
  ExpectMovedBy(kMotion, shrunk, map_);
  EXPECT_EQ(test::ContradictionIn(map_), "");
}

TEST_F(BundleProblemTest, AppliedToAnUnchangedMapIsTheSolution) {
  MakeMap(4);
  const BundleProblem before = MakeGlobalBundle({}, map_, scene_.camera.lens());
  BundleProblem after = before;
  after.views[2].cam_from_map = kMotion;
  after.landmarks[7].position_in_map = {1.0, 2.0, 3.0};
  Map expected = map_;
  ApplyBundle(after, &expected);
  ApplyStaleBundle(before, after, &map_);
  ExpectMovedBy(Rigid3(), expected, map_);
}

TEST_F(BundleProblemTest, LocalBundleFreesTheViewsThatShareMostAndFixesTheRest) {
  MakeMap(8);
  BundleOptions options;
  options.num_local_views = 2;
  const BundleProblem problem = MakeLocalBundle(options, map_, scene_.camera.lens(), {0});
  std::vector<std::uint32_t> free_views;
  for (const BundleView& view : problem.views) {
    if (!view.is_fixed) free_views.push_back(view.photo.value);
  }
  EXPECT_EQ(free_views, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_GT(problem.views.size(), 3U);
  EXPECT_LT(problem.views.size(), 8U);  // The far end of the row sees none of their landmarks.
}

TEST_F(BundleProblemTest, LocalBundleOfTheWholeMapFixesTheOldestView) {
  MakeMap(3);
  const BundleProblem problem = MakeLocalBundle({}, map_, scene_.camera.lens(), {2});
  ASSERT_EQ(problem.views.size(), 3U);
  for (const BundleView& view : problem.views) {
    EXPECT_EQ(view.is_fixed, view.photo == PhotoId{0}) << view.photo.value;
  }
}

TEST_F(BundleProblemTest, GlobalBundleHoldsEveryObservationAndWeighsThemByScale) {
  MakeMap(4);
  const BundleProblem problem = MakeGlobalBundle({}, map_, scene_.camera.lens());
  EXPECT_EQ(problem.views.size(), 4U);
  EXPECT_EQ(problem.landmarks.size(), map_.num_landmarks());
  EXPECT_EQ(problem.observations.size(), map_.num_observations());
  double smallest = 1.0;
  for (const BundleObservation& observation : problem.observations) {
    EXPECT_LE(observation.weight, 1.0);
    smallest = std::min(smallest, observation.weight);
  }
  EXPECT_NEAR(smallest, 0.25, 0.1);  // Scales of these photos differ up to fourfold.
}

}  // namespace
}  // namespace plumb
