// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The predicted accuracy, and the noise it is scaled by.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "plumbline/quality/quality_map.h"
#include "test/quality/quality_scene.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using Vector = Eigen::Vector3d;

FaceQuality QualityOfSmallFace(const Vector& middle, const std::vector<Vector>& eyes) {
  test::Soup soup = {{middle, middle + Vector(0.003, 0, 0), middle + Vector(0, 0, 0.003)}};
  MapDelta delta;
  for (const Vector& eye : eyes) {
    const auto photo = static_cast<std::uint32_t>(delta.views_set.size());
    delta.views_set.push_back(test::MakeView(photo, test::LookAt(eye, middle)));
  }
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(delta, test::SnapshotOf(soup));
  return map.blocks().begin()->second.qualities[0];
}

// Two rays that meet under the angle 2 a, each with a lateral standard deviation s: information
// 2 s^-2 sin^2 a in the depth, the least; thus sigma = s / (sqrt(2) sin a).
TEST(PredictedAccuracy, OfTwoRaysIsThatOfTheirAngle) {
  const double half_angle = 0.2;
  const double distance = 5.0;
  const double s = distance / 500.0;
  const Vector middle(0.5, 0, 0.5);
  const FaceQuality quality = QualityOfSmallFace(
      middle,
      {middle + distance * Vector(std::sin(half_angle), -std::cos(half_angle), 0),
       middle + distance * Vector(-std::sin(half_angle), -std::cos(half_angle), 0)});
  const double expected = s / (std::sqrt(2.0) * std::sin(half_angle));
  EXPECT_NEAR(quality.sigma_per_px, expected, 0.01 * expected);
}

TEST(PredictedAccuracy, IsUnknownWithoutParallax) {
  EXPECT_TRUE(std::isinf(QualityOfSmallFace({0, 0, 0}, {{0, -5, 0}}).sigma_per_px));
  EXPECT_TRUE(std::isinf(QualityOfSmallFace({0, 0, 0}, {{0, -5, 0}, {0, -5, 0}}).sigma_per_px));
  EXPECT_TRUE(std::isinf(QualityOfSmallFace({0, 0, 0}, {{0, -5, 0}, {0.001, -5, 0}}).sigma_per_px));
}

// Points measured with noise scatter as predicted: Monte Carlo over the linearised intersection.
TEST(PredictedAccuracy, IsTheScatterOfPointsMeasuredWithNoise) {
  const Vector middle(0.5, 0, 0.5);
  const std::vector<Vector> eyes = {{-1, -4, 0.4}, {0.6, -5, 1.0}, {2.2, -4.5, 0.2}};
  const FaceQuality quality = QualityOfSmallFace(middle, eyes);
  test::Random random(3);
  const double noise_px = 0.3;
  const Camera camera = test::SmallCamera();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  const int num_trials = 4000;
  for (int trial = 0; trial < num_trials; ++trial) {
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Vector right_side = Vector::Zero();
    for (const Vector& eye : eyes) {
      const Rigid3 cam_from_map = test::LookAt(eye, middle);
      Eigen::Matrix<double, 2, 3> jacobian;
      for (int k = 0; k < 3; ++k) {  // Central differences.
        const Vector step = 1e-5 * Vector::Unit(k);
        jacobian.col(k) = (*camera.Project(cam_from_map * (middle + step)) -
                           *camera.Project(cam_from_map * (middle - step))) /
                          2e-5;
      }
      normal_matrix += jacobian.transpose() * jacobian;
      right_side += jacobian.transpose() * random.Normal2(noise_px);
    }
    const Vector error = normal_matrix.ldlt().solve(right_side);
    scatter += error * error.transpose() / num_trials;
  }
  const double largest =
      std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[2]);
  EXPECT_NEAR(quality.sigma_per_px * noise_px, largest, 0.05 * largest);  // 1/sqrt(2 * 4000) = 1 %.
}

// A bundle of 8 photos and 4000 points, whose positions are fitted to what the photos measured.
MapDelta NoisyBundle(double noise_px, double outlier_share) {
  test::Random random(5);
  const Camera camera = test::SmallCamera();
  MapDelta delta;
  delta.is_snapshot = true;
  for (std::uint32_t i = 0; i < 8; ++i) {
    delta.views_set.push_back(test::MakeView(i, test::LookAt({0.5 * i, -5, 1}, {0.5 * i, 0, 1})));
  }
  for (std::uint32_t id = 0; id < 4000; ++id) {
    const Vector point(random.Uniform(0.5, 3.0), random.Uniform(-0.3, 0.3), random.Uniform(0, 2));
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Vector right_side = Vector::Zero();
    for (const ViewState& view : delta.views_set) {
      const Eigen::Vector2d pixel = *camera.Project(view.cam_from_map * point);
      if (!camera.IsInImage(pixel)) continue;
      Eigen::Vector2d error = random.Normal2(noise_px);
      if (random.Uniform(0.0, 1.0) < outlier_share) error *= 20.0;
      Eigen::Matrix<double, 2, 3> jacobian;
      for (int k = 0; k < 3; ++k) {
        const Vector step = 1e-5 * Vector::Unit(k);
        jacobian.col(k) = (*camera.Project(view.cam_from_map * (point + step)) -
                           *camera.Project(view.cam_from_map * (point - step))) /
                          2e-5;
      }
      normal_matrix += jacobian.transpose() * jacobian;
      right_side += jacobian.transpose() * error;
      delta.observations_added.push_back(
          {LandmarkId{id}, view.photo, id, (pixel + error).cast<float>()});
    }
    delta.landmarks_set.push_back(
        {LandmarkId{id}, point + normal_matrix.ldlt().solve(right_side), {0, 0, 0}});
  }
  return delta;
}

TEST(BundleNoise, IsThatOfTheMeasurements) {
  for (const double noise_px : {0.2, 0.7}) {
    QualityMap map{QualityOptions()};
    map.SetCamera(test::SmallCamera());
    EXPECT_TRUE(map.Apply(NoisyBundle(noise_px, 0.0), {}).is_noise_changed);
    EXPECT_NEAR(map.noise_px(), noise_px, 0.12 * noise_px);  // Half a step is 5 %.
  }
}

TEST(BundleNoise, IsNotTakenInByOutliers) {
  QualityMap map{QualityOptions()};
  map.SetCamera(test::SmallCamera());
  map.Apply(NoisyBundle(0.4, 0.03), {});
  EXPECT_NEAR(map.noise_px(), 0.4, 0.25 * 0.4);  // They also pull the points they belong to.
}

TEST(BundleNoise, IsTheDefaultWhileThereIsNothingToTellItFrom) {
  QualityOptions options;
  options.default_noise_px = 0.8;
  QualityMap map(options);
  map.SetCamera(test::SmallCamera());
  MapDelta delta = NoisyBundle(0.2, 0.0);
  map.Apply(delta, {});
  EXPECT_LT(map.noise_px(), 0.3);
  delta.observations_added.resize(50);
  EXPECT_TRUE(map.Apply(delta, {}).is_noise_changed);  // A snapshot replaces all.
  EXPECT_EQ(map.noise_px(), 0.8);
}

class BundleNoiseTaken : public testing::Test {
 protected:
  BundleNoiseTaken() {
    map_.SetCamera(test::SmallCamera());
    map_.Apply(bundle_, {});
    EXPECT_LT(map_.noise_px(), 0.3);
  }

  MapDelta bundle_ = NoisyBundle(0.2, 0.0);
  QualityMap map_{QualityOptions()};
};

TEST_F(BundleNoiseTaken, LandmarksCountNoMore) {
  MapDelta gone;
  for (const LandmarkState& landmark : bundle_.landmarks_set) {
    gone.landmarks_removed.push_back(landmark.id);
  }
  map_.Apply(gone, {});
  EXPECT_EQ(map_.noise_px(), QualityOptions().default_noise_px);
}

TEST_F(BundleNoiseTaken, ObservationsCountNoMore) {
  MapDelta gone;
  gone.observations_removed = bundle_.observations_added;
  map_.Apply(gone, {});
  EXPECT_EQ(map_.noise_px(), QualityOptions().default_noise_px);
}

TEST_F(BundleNoiseTaken, ViewsTakeTheirObservationsAlong) {
  MapDelta gone;
  for (const ViewState& view : bundle_.views_set) gone.views_removed.push_back(view.photo);
  map_.Apply(gone, {});
  MapDelta back;  // Placed anew, and nothing measured in them yet.
  back.views_set = bundle_.views_set;
  map_.Apply(back, {});
  EXPECT_EQ(map_.noise_px(), QualityOptions().default_noise_px);
}

TEST(QualityOptions, RefusesNonsense) {
  QualityOptions options;
  options.default_noise_px = 0.0;
  EXPECT_THROW(QualityMap{options}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb
