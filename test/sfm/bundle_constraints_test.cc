// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bundle_constraints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "plumbline/geometry/similarity3.h"
#include "plumbline/sfm/bundle_problem.h"
#include "test/sfm/scene_photos.h"

namespace plumb {
namespace {

using test::Scene;
using test::SceneOptions;

constexpr int kManyIterations = 60;
constexpr double kTolerance = 1e-14;
constexpr double kSurveySigma_m = 0.001;
constexpr double kMarkerSigma_px = 0.05;

// A map of a row of photos, with markers among the scene's points.
class BundleConstraintsTest : public testing::Test {
 protected:
  explicit BundleConstraintsTest(const SceneOptions& options = RowOfSix())
      : scene_(MakeScene(options)), photos_(test::MakeScenePhotos(scene_)) {
    const PhotoRecords records = test::MakeRecords(scene_.camera, photos_);
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < 6; ++i) {
      test::AddViewAt(records, {i}, scene_.cams_from_map[i], &map_);
      ids.push_back(i);
    }
    test::AddTrueLandmarks(scene_, photos_, ids, &map_);
  }

  static SceneOptions RowOfSix() {
    SceneOptions options;
    options.num_points = 300;
    options.num_cameras = 6;
    return options;
  }

  // A marker at `truth_in_map`, seen by every photo that has it in its image.
  MarkerTrack Marker(int id, const Eigen::Vector3d& truth_in_map) const {
    MarkerTrack track;
    track.marker_id = id;
    track.position_in_map = truth_in_map;
    for (std::uint32_t k = 0; k < scene_.cams_from_map.size(); ++k) {
      const auto pixel = scene_.camera.Project(scene_.cams_from_map[k] * truth_in_map);
      if (!pixel || !scene_.camera.IsInImage(*pixel)) continue;
      track.sightings.push_back({{k}, *pixel, kMarkerSigma_px});
    }
    return track;
  }

  BundleConstraints ControlPoints() const {
    BundleConstraints constraints;
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(-5, 0, -3), {5, 0, -3}, {-4, 0.5, 3}, {4, 0, 3.5}}) {
      MarkerTrack track = Marker(static_cast<int>(constraints.markers.size()), point);
      track.survey = MeasuredPosition{point, kSurveySigma_m};
      constraints.markers.push_back(track);
    }
    return constraints;
  }

  BundleProblem Problem(const BundleConstraints& constraints,
                        double distance_exponent = 0.0) const {
    BundleOptions options;
    options.distance_exponent = distance_exponent;
    return MakeGlobalBundle(options, map_, scene_.camera.lens(), constraints);
  }

  // Of the camera centres against the truth.
  double LargestError(const BundleProblem& problem) const {
    double largest = 0.0;
    for (const BundleView& view : problem.views) {
      const Rigid3& truth = scene_.cams_from_map[view.photo.value];
      largest = std::max(
          largest,
          (view.cam_from_map.TargetOriginInSource() - truth.TargetOriginInSource()).norm());
    }
    return largest;
  }

  Scene scene_;
  std::vector<test::ScenePhoto> photos_;
  Map map_;
};

// Bent, moved and scaled: what an unconstrained bundle would leave as it is, it would only unbend.
void MoveAll(double scale, const Eigen::Vector3d& shift, BundleProblem* problem) {
  for (BundleView& view : problem->views) {
    const Eigen::Quaterniond& rotation = view.cam_from_map.rotation;
    const Eigen::Vector3d center = scale * view.cam_from_map.TargetOriginInSource() + shift;
    view.cam_from_map = Rigid3(rotation, -(rotation * center));
  }
  for (auto& landmark : problem->landmarks) {
    landmark.position_in_map = scale * landmark.position_in_map + shift;
  }
  for (auto& marker : problem->markers) {
    marker.position_in_map = scale * marker.position_in_map + shift;
  }
}

BundleReport Solve(const BundleOptions& options, BundleProblem* problem) {
  return SolveBundle(options, kManyIterations, kTolerance, nullptr, problem);
}

TEST_F(BundleConstraintsTest, ControlPointsHoldPlaceTurnAndScale) {
  BundleProblem problem = Problem(ControlPoints());
  ASSERT_EQ(problem.markers.size(), 4U);
  MoveAll(1.01, {0.05, -0.03, 0.02}, &problem);
  EXPECT_GT(LargestError(problem), 0.1);
  BundleOptions options;
  options.huber_width_px = 1e6;  // From so far off every residual is an outlier.
  ASSERT_TRUE(Solve(options, &problem).is_usable);
  EXPECT_LT(LargestError(problem), 1e-5);
}

TEST_F(BundleConstraintsTest, CheckPointsMoveNothingButAreMeasured) {
  BundleConstraints constraints = ControlPoints();
  const Eigen::Vector3d truth = constraints.markers[3].position_in_map;
  constraints.markers[3].survey.reset();
  constraints.markers[3].position_in_map += Eigen::Vector3d(0.01, 0.02, -0.01);
  BundleProblem problem = Problem(constraints);
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  EXPECT_LT((problem.markers[3].position_in_map - truth).norm(), 1e-5);
}

TEST_F(BundleConstraintsTest, AControlPointBendsAsMuchAsItsSigmaAllows) {
  const auto residual_m = [&](double sigma_m) {
    BundleConstraints constraints = ControlPoints();
    constraints.markers[0].survey->position_in_map.z() += 0.01;
    constraints.markers[0].survey->sigma = sigma_m;
    BundleProblem problem = Problem(constraints);
    EXPECT_TRUE(Solve({}, &problem).is_usable);
    return (problem.markers[0].position_in_map - constraints.markers[0].survey->position_in_map)
        .norm();
  };
  EXPECT_GT(residual_m(0.05), 0.009);   // Far less sure than the photos: it is not followed.
  EXPECT_LT(residual_m(1e-5), 0.0005);  // Far surer than they: the model bends.
}

TEST_F(BundleConstraintsTest, CameraPriorsHoldTheGaugeToo) {
  BundleConstraints constraints;
  for (std::uint32_t k = 0; k < 6; ++k) {
    constraints.centers.push_back({{k}, {scene_.cams_from_map[k].TargetOriginInSource(), 0.02}});
  }
  constraints.centers.push_back({{77}, {Eigen::Vector3d::Zero(), 0.02}});  // Not in the map.
  BundleProblem problem = Problem(constraints);
  ASSERT_EQ(problem.centers.size(), 6U);
  MoveAll(1.01, {0.05, -0.03, 0.02}, &problem);
  BundleOptions options;
  options.huber_width_px = 1e6;
  ASSERT_TRUE(Solve(options, &problem).is_usable);
  EXPECT_LT(LargestError(problem), 1e-3);
}

TEST_F(BundleConstraintsTest, LeavesOutMarkersThatSayNothing) {
  BundleConstraints constraints = ControlPoints();
  constraints.markers[0].sightings.clear();  // Surveyed, but not seen.
  constraints.markers[1].survey.reset();     // Seen once, not surveyed.
  constraints.markers[1].sightings.resize(1);
  const Eigen::Vector3d behind(0.0, -30.0, 0.0);
  constraints.markers[2].position_in_map = behind;
  const BundleProblem problem = Problem(constraints);
  ASSERT_EQ(problem.markers.size(), 1U);
  EXPECT_EQ(problem.markers[0].marker_id, 3);
  for (const BundleSighting& sighting : problem.sightings) EXPECT_EQ(sighting.marker_idx, 0U);
}

// As an unconstrained bundle, or a map that was begun anew, may leave it.
Similarity3 AnotherGauge() {
  return {1.7,
          Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())),
          {5.0, -3.0, 2.0}};
}

TEST_F(BundleConstraintsTest, FollowAMapThatMoved) {
  const BundleConstraints before = ControlPoints();
  const Similarity3 now_from_before = AnotherGauge();
  for (const PhotoId photo : {PhotoId{0}, {1}, {2}, {3}, {4}, {5}}) {
    map_.MoveView(photo, TransformCamera(now_from_before, map_.view(photo).cam_from_map));
  }
  const BundleConstraints now = MovedWithMap(before, scene_.camera, map_);
  ASSERT_EQ(now.markers.size(), before.markers.size());
  for (std::size_t i = 0; i < now.markers.size(); ++i) {
    const Eigen::Vector3d expected = now_from_before * before.markers[i].position_in_map;
    EXPECT_LT((now.markers[i].position_in_map - expected).norm(), 1e-6);
    EXPECT_LT((now.markers[i].survey->position_in_map - expected).norm(), 1e-6);
    EXPECT_NEAR(now.markers[i].survey->sigma, 1.7 * kSurveySigma_m, 1e-9);
    EXPECT_EQ(now.markers[i].sightings.size(), before.markers[i].sightings.size());
  }
}

TEST_F(BundleConstraintsTest, StayWhereTheyAreWithAMapThatStays) {
  BundleConstraints before = ControlPoints();
  before.markers[1].survey->position_in_map.z() += 0.01;  // What the survey says is not changed.
  before.centers.push_back({{2}, {Eigen::Vector3d(1, 2, 3), 0.5}});
  const BundleConstraints now = MovedWithMap(before, scene_.camera, map_);
  for (std::size_t i = 0; i < now.markers.size(); ++i) {
    EXPECT_LT(
        (now.markers[i].survey->position_in_map - before.markers[i].survey->position_in_map).norm(),
        1e-6);
  }
  EXPECT_LT((now.centers[0].center.position_in_map - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
}

TEST_F(BundleConstraintsTest, OneMarkerThatMovedAgainstTheOthersDoesNotTurnThem) {
  BundleConstraints before = ControlPoints();
  before.markers.push_back(Marker(4, {0, 0, 0}));
  before.markers.back().position_in_map.x() += 1.0;
  const BundleConstraints now = MovedWithMap(before, scene_.camera, map_);
  EXPECT_LT((now.markers[4].position_in_map - Eigen::Vector3d::Zero()).norm(), 1e-6);
  EXPECT_LT(
      (now.markers[0].survey->position_in_map - before.markers[0].survey->position_in_map).norm(),
      1e-6);
}

TEST_F(BundleConstraintsTest, SurveysThatCannotFollowAreLeftOut) {
  BundleConstraints before = ControlPoints();
  before.markers.resize(2);
  before.centers.push_back({PhotoId{0}, {}});
  const BundleConstraints now = MovedWithMap(before, scene_.camera, map_);
  ASSERT_EQ(now.markers.size(), 2U);
  EXPECT_TRUE(now.centers.empty());
  for (const MarkerTrack& track : now.markers) EXPECT_FALSE(track.survey);
  EXPECT_TRUE(MovedWithMap({}, scene_.camera, map_).markers.empty());
}

TEST_F(BundleConstraintsTest, AMarkerSeenByOneViewGoesWithTheOthers) {
  BundleConstraints before = ControlPoints();
  before.markers[2].sightings.resize(1);
  const Similarity3 now_from_before = AnotherGauge();
  for (const PhotoId photo : {PhotoId{0}, {1}, {2}, {3}, {4}, {5}}) {
    map_.MoveView(photo, TransformCamera(now_from_before, map_.view(photo).cam_from_map));
  }
  const BundleConstraints now = MovedWithMap(before, scene_.camera, map_);
  const Eigen::Vector3d expected = now_from_before * before.markers[2].position_in_map;
  EXPECT_LT((now.markers[2].position_in_map - expected).norm(), 1e-6);
  EXPECT_LT((now.markers[2].survey->position_in_map - expected).norm(), 1e-6);
}

class MultiScaleTest : public BundleConstraintsTest {
 protected:
  MultiScaleTest() : BundleConstraintsTest(TowardsAWall()) {}

  static SceneOptions TowardsAWall() {  // From 10 m to 5 m.
    SceneOptions options = RowOfSix();
    options.approach_m = 1.0;
    options.relief_m = 0.0;
    options.max_turn_rad = 0.0;
    return options;
  }
};

TEST_F(MultiScaleTest, WeighsPhotosByTheDistanceOfTheirScene) {
  const BundleProblem alike = Problem({});
  const BundleProblem scaled = Problem({}, 2.0);
  ASSERT_EQ(alike.observations.size(), scaled.observations.size());
  std::map<std::uint32_t, double> factors;  // By view.
  for (std::size_t i = 0; i < alike.observations.size(); ++i) {
    const double factor = scaled.observations[i].weight / alike.observations[i].weight;
    const auto [it, is_new] = factors.try_emplace(scaled.observations[i].view_idx, factor);
    EXPECT_NEAR(it->second, factor, 1e-12);  // One a photo.
  }
  ASSERT_EQ(factors.size(), 6U);
  const double distance_ratio = 10.0 / 5.0;
  EXPECT_NEAR(factors.at(0) / factors.at(5), distance_ratio * distance_ratio, 0.4);
  for (std::uint32_t k = 1; k < 6; ++k) EXPECT_LT(factors.at(k), factors.at(k - 1));
}

}  // namespace
}  // namespace plumb
