// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/map_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plumbline/sfm/landmark_accuracy.h"
#include "test/sfm/scene_photos.h"

namespace plumb {
namespace {

using test::Scene;
using test::SceneOptions;

constexpr double kNoise_px = 0.3;

// A row of twelve photos before a facade, as it was mapped with a wrong lens: domed.
class MapRefinementTest : public testing::Test {
 protected:
  MapRefinementTest() : scene_(MakeScene(Row())), map_(MakeTrueMap()) {}

  static SceneOptions Row() {
    SceneOptions options;
    options.num_points = 500;
    options.num_cameras = 12;
    options.spacing_m = 1.0;
    options.noise_px = kNoise_px;
    return options;
  }

  Map MakeTrueMap() const { return test::MakeTrueMap(scene_, test::MakeScenePhotos(scene_)); }

  // Everything is moved backwards by up to `height_m` in the middle of the facade.
  void Bend(double height_m) {
    const auto shift = [&](const Eigen::Vector3d& point) {
      return Eigen::Vector3d(0.0, height_m * (1.0 - std::pow(point.x() / 8.0, 2)), 0.0);
    };
    for (const LandmarkId id : map_.LandmarkIds()) {
      const Eigen::Vector3d point = map_.landmark(id).position_in_map;
      map_.MoveLandmark(id, point + shift(point));
    }
    for (std::uint32_t k = 0; k < scene_.cams_from_map.size(); ++k) {
      const Rigid3& truth = scene_.cams_from_map[k];
      const Eigen::Vector3d center = truth.TargetOriginInSource();
      const Eigen::Vector3d bent = center + shift(center);
      map_.MoveView({k}, {truth.rotation, -(truth.rotation * bent)});
    }
  }

  Camera WithK1(double k1) const {
    LensParameters<double> lens = scene_.camera.lens();
    lens[kK1] += k1;
    return {
        "wrong", scene_.camera.width_px(), scene_.camera.height_px(), scene_.camera.model(), lens};
  }

  BundleConstraints ControlPoints() const {
    BundleConstraints constraints;
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(-6, 0, -3),
                                         {0, 0, -3},
                                         {6, 0, -3},
                                         {-6, 0.5, 3},
                                         {0, 0.5, 3},
                                         {6, 0, 3}}) {
      MarkerTrack track;
      track.marker_id = static_cast<int>(constraints.markers.size());
      track.position_in_map = point;
      track.survey = MeasuredPosition{point, 0.001};
      for (std::uint32_t k = 0; k < scene_.cams_from_map.size(); ++k) {
        const auto pixel = scene_.camera.Project(scene_.cams_from_map[k] * point);
        if (pixel && scene_.camera.IsInImage(*pixel)) track.sightings.push_back({{k}, *pixel, 0.1});
      }
      constraints.markers.push_back(std::move(track));
    }
    return constraints;
  }

  // Largest distance of a well seen landmark from where it truly is.
  double LargestError_m() const {
    double largest = 0.0;
    for (const LandmarkId id : map_.LandmarkIds()) {
      const Landmark& landmark = map_.landmark(id);
      if (landmark.track.size() < 4) continue;
      double nearest = 1e9;
      for (const Eigen::Vector3d& truth : scene_.points_in_map) {
        nearest = std::min(nearest, (landmark.position_in_map - truth).norm());
      }
      largest = std::max(largest, nearest);
    }
    return largest;
  }

  MapRefinement Refine(const BundleConstraints& constraints, const Camera& camera) {
    return RefineMap({}, camera, constraints, &map_);
  }

  Scene scene_;
  Map map_;
};

TEST_F(MapRefinementTest, ControlPointsPullABentMapStraightAndMendTheLens) {
  Bend(0.05);
  ASSERT_GT(LargestError_m(), 0.03);
  const MapRefinement refinement = Refine(ControlPoints(), WithK1(0.004));
  ASSERT_TRUE(refinement.is_usable);
  EXPECT_LT(refinement.last.final_cost, refinement.first.initial_cost);
  EXPECT_NEAR(refinement.camera.lens()[kK1], scene_.camera.lens()[kK1], 5e-4);
  // Noise of 0.3 px at 10 m is 1.2 mm across and, at a baseline of some metres, 6 mm along a ray.
  EXPECT_LT(LargestError_m(), 0.02);
}

TEST_F(MapRefinementTest, AWrongControlPointBendsTheMapByABoundedForce) {
  Refine(ControlPoints(), scene_.camera);
  const double error_m = LargestError_m();
  map_ = MakeTrueMap();
  BundleConstraints constraints = ControlPoints();
  constraints.markers[1].survey->position_in_map.y() += 0.5;
  ASSERT_TRUE(Refine(constraints, scene_.camera).is_usable);
  EXPECT_LT(LargestError_m(), error_m + 0.02);  // Of the 0.5 m.
}

TEST_F(MapRefinementTest, TheLensIsHeldWhereTheOptionsSaySo) {
  RefinementOptions options;
  options.bundle.refine_focal_length = false;
  options.bundle.refine_principal_point = false;
  options.bundle.refine_distortion = false;
  const Camera camera = WithK1(0.001);
  const MapRefinement refinement = RefineMap(options, camera, {}, &map_);
  EXPECT_EQ(refinement.camera.lens(), camera.lens());
  map_.TakeDelta();
  EXPECT_FALSE(map_.Snapshot().lens);
}

TEST_F(MapRefinementTest, WhatDoesNotFitIsRemovedAndTold) {
  map_.TakeDelta();
  const LandmarkId id = map_.LandmarkIds()[0];
  const std::size_t num_before = map_.num_observations();
  map_.MoveLandmark(id, map_.landmark(id).position_in_map + Eigen::Vector3d(0.0, 400.0, 0.0));
  const MapRefinement refinement = Refine({}, scene_.camera);
  ASSERT_TRUE(refinement.is_usable);
  EXPECT_EQ(num_before - map_.num_observations(), refinement.num_removed);
  const auto delta = map_.TakeDelta();
  ASSERT_TRUE(delta);
  EXPECT_TRUE(delta->observations_added.empty());
  EXPECT_TRUE(delta->views_removed.empty());
  EXPECT_TRUE(delta->lens);
}

TEST_F(MapRefinementTest, AnEmptyMapIsNotUsable) {
  Map empty;
  EXPECT_FALSE(RefineMap({}, scene_.camera, {}, &empty).is_usable);
}

TEST_F(MapRefinementTest, RefusesImpossibleOptions) {
  RefinementOptions options;
  options.num_rounds = 0;
  EXPECT_THROW(RefineMap(options, scene_.camera, {}, &map_), std::invalid_argument);
}

// Of landmarks with noise in their pixels alone.
class LandmarkAccuracyTest : public MapRefinementTest {
 protected:
  static double Median(std::vector<double> values) {
    std::nth_element(
        values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
    return values[values.size() / 2];
  }
};

TEST_F(LandmarkAccuracyTest, TheNoiseIsFoundInTheResiduals) {
  const MapRefinement refinement = Refine({}, scene_.camera);
  ASSERT_TRUE(refinement.is_usable);
  // Weights are at most 1, and 1 for a photo's finest feature only.
  const AccuracyPrediction prediction = PredictLandmarkAccuracy(map_, refinement.camera.lens());
  EXPECT_LT(prediction.sigma_px, kNoise_px);
  EXPECT_GT(prediction.sigma_px, 0.3 * kNoise_px);
}

TEST_F(LandmarkAccuracyTest, MoreRaysMakeAPointMoreCertain) {
  const AccuracyPrediction prediction = PredictLandmarkAccuracy(map_, scene_.camera.lens());
  ASSERT_EQ(prediction.landmarks.size(), map_.num_landmarks());
  std::vector<double> few;
  std::vector<double> many;
  for (const LandmarkAccuracy& landmark : prediction.landmarks) {
    if (landmark.num_observations <= 7) few.push_back(landmark.RaySigma());
    if (landmark.num_observations >= 11) many.push_back(landmark.RaySigma());
    EXPECT_GT(landmark.relief_sigma, 0.0);
    EXPECT_GT(landmark.Sigma(), landmark.RaySigma());
  }
  ASSERT_GT(few.size(), 10U);
  ASSERT_GT(many.size(), 10U);
  EXPECT_GT(Median(few), Median(many));
}

TEST_F(LandmarkAccuracyTest, GrowsWithTheMap) {  // Law: no hidden unit of length.
  const double sigma = Median([&] {
    std::vector<double> sigmas;
    for (const auto& landmark : PredictLandmarkAccuracy(map_, scene_.camera.lens()).landmarks) {
      sigmas.push_back(landmark.Sigma());
    }
    return sigmas;
  }());
  for (const LandmarkId id : map_.LandmarkIds()) {
    map_.MoveLandmark(id, 10.0 * map_.landmark(id).position_in_map);
  }
  const Map before = map_;
  for (const auto& [photo, view] : before.views()) {
    map_.MoveView(photo, {view.cam_from_map.rotation, 10.0 * view.cam_from_map.translation});
  }
  std::vector<double> sigmas;
  for (const auto& landmark : PredictLandmarkAccuracy(map_, scene_.camera.lens()).landmarks) {
    sigmas.push_back(landmark.Sigma());
  }
  EXPECT_NEAR(Median(sigmas), 10.0 * sigma, 1e-6 * sigma);
}

}  // namespace
}  // namespace plumb
