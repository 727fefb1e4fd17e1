// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "plumbline/geometry/alignment.h"
#include "plumbline/sfm/bundle_problem.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::Random;
using test::Scene;
using test::SceneOptions;

constexpr int kManyIterations = 60;
constexpr double kTolerance = 1e-14;

SceneOptions RowOfSix() {
  SceneOptions options;
  options.num_points = 150;
  options.num_cameras = 6;
  return options;
}

// The problem of a scene as its truth is; of the points that at least two cameras see.
BundleProblem MakeProblem(const Scene& scene) {
  BundleProblem problem;
  problem.lens = scene.camera.lens();
  std::vector<int> num_seen(scene.points_in_map.size(), 0);
  for (const auto& observations : scene.observations) {
    for (const auto& seen : observations) ++num_seen[static_cast<std::size_t>(seen.point_idx)];
  }
  std::vector<std::uint32_t> landmark_of_point(scene.points_in_map.size());
  for (std::uint32_t p = 0; p < num_seen.size(); ++p) {
    landmark_of_point[p] = static_cast<std::uint32_t>(problem.landmarks.size());
    if (num_seen[p] >= 2) problem.landmarks.push_back({{p}, scene.points_in_map[p]});
  }
  for (std::uint32_t k = 0; k < scene.cams_from_map.size(); ++k) {
    problem.views.push_back({{k}, scene.cams_from_map[k], false});
    for (const auto& seen : scene.observations[k]) {
      const auto point = static_cast<std::size_t>(seen.point_idx);
      if (num_seen[point] < 2) continue;
      problem.observations.push_back({k, landmark_of_point[point], seen.pixel, 1.0});
    }
  }
  return problem;
}

// Moves all that is free away from where it is.
void Disturb(double turn_rad, double shift_m, BundleProblem* problem) {
  Random random(11);
  for (BundleView& view : problem->views) {
    if (view.is_fixed) continue;
    const Eigen::Vector3d turn = random.InBox(turn_rad);
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    view.cam_from_map = Rigid3(rotation, random.InBox(shift_m)) * view.cam_from_map;
  }
  for (BundleLandmark& landmark : problem->landmarks) {
    landmark.position_in_map += random.InBox(shift_m);
  }
}

// Centres of the views, then the landmarks.
std::vector<Eigen::Vector3d> PositionsOf(const BundleProblem& problem) {
  std::vector<Eigen::Vector3d> positions;
  for (const BundleView& view : problem.views) {
    positions.push_back(view.cam_from_map.TargetOriginInSource());
  }
  for (const BundleLandmark& landmark : problem.landmarks) {
    positions.push_back(landmark.position_in_map);
  }
  return positions;
}

double LargestDistance(const BundleProblem& a, const BundleProblem& b) {
  const std::vector<double> distances =
      AlignmentResiduals(Similarity3(), PositionsOf(a), PositionsOf(b));
  return *std::max_element(distances.begin(), distances.end());
}

double LargestTurn(const BundleProblem& a, const BundleProblem& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    const Eigen::Quaterniond& rotation = a.views[i].cam_from_map.rotation;
    largest = std::max(largest, rotation.angularDistance(b.views[i].cam_from_map.rotation));
  }
  return largest;
}

double LargestCenterError(const BundleProblem& solved, const BundleProblem& truth) {
  double largest = 0.0;
  for (std::size_t i = 0; i < truth.views.size(); ++i) {
    largest = std::max(largest,
                       (solved.views[i].cam_from_map.TargetOriginInSource() -
                        truth.views[i].cam_from_map.TargetOriginInSource())
                           .norm());
  }
  return largest;
}

void FixFirstTwo(BundleProblem* problem) {
  problem->views[0].is_fixed = true;
  problem->views[1].is_fixed = true;
}

BundleReport Solve(const BundleOptions& options, BundleProblem* problem) {
  return SolveBundle(options, kManyIterations, kTolerance, nullptr, problem);
}

TEST(SolveBundle, FindsNoiseFreeTruthUpToASimilarity) {
  const BundleProblem truth = MakeProblem(MakeScene(RowOfSix()));
  BundleProblem problem = truth;
  Disturb(0.02, 0.1, &problem);
  const BundleReport report = Solve({}, &problem);
  ASSERT_TRUE(report.is_usable);
  EXPECT_GT(report.initial_cost, 1e4);
  EXPECT_LT(report.final_cost, 1e-6);
  EXPECT_GE(report.num_iterations, 2);

  const auto truth_from_solved = AlignPoints(PositionsOf(problem), PositionsOf(truth));
  ASSERT_TRUE(truth_from_solved);
  for (const double residual_m :
       AlignmentResiduals(*truth_from_solved, PositionsOf(problem), PositionsOf(truth))) {
    EXPECT_LT(residual_m, 1e-6);
  }
}

TEST(SolveBundle, WithTwoFixedViewsFindsTheTruthItself) {
  const BundleProblem truth = MakeProblem(MakeScene(RowOfSix()));
  BundleProblem problem = truth;
  FixFirstTwo(&problem);
  Disturb(0.02, 0.1, &problem);
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  EXPECT_LT(LargestDistance(problem, truth), 1e-6);
  EXPECT_LT(LargestTurn(problem, truth), 1e-7);
}

TEST(SolveBundle, LeavesFixedViewsWhereTheyAre) {
  BundleProblem problem = MakeProblem(MakeScene(RowOfSix()));
  Disturb(0.02, 0.1, &problem);  // The fixed views too: they must not be drawn to the truth.
  FixFirstTwo(&problem);
  const BundleProblem before = problem;
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  for (std::size_t i = 0; i < 2; ++i) {
    const Rigid3& start = before.views[i].cam_from_map;
    EXPECT_EQ(problem.views[i].cam_from_map.translation, start.translation);
    EXPECT_EQ(problem.views[i].cam_from_map.rotation.coeffs(), start.rotation.coeffs());
  }
  EXPECT_GT(
      (problem.views[2].cam_from_map.translation - before.views[2].cam_from_map.translation).norm(),
      1e-3);
}

TEST(SolveBundle, HoldsTheGaugeOfAProblemWithoutFixedViews) {
  BundleProblem problem = MakeProblem(MakeScene(RowOfSix()));
  Disturb(0.02, 0.1, &problem);
  const BundleProblem before = problem;
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  const Rigid3& first = problem.views[0].cam_from_map;
  EXPECT_LT(
      (first.TargetOriginInSource() - before.views[0].cam_from_map.TargetOriginInSource()).norm(),
      1e-12);
  EXPECT_LT(first.rotation.angularDistance(before.views[0].cam_from_map.rotation), 1e-7);
  // The cameras stand along x: that coordinate of the last one carries the scale.
  EXPECT_NEAR(problem.views[5].cam_from_map.TargetOriginInSource().x(),
              before.views[5].cam_from_map.TargetOriginInSource().x(),
              1e-12);
}

TEST(SolveBundle, BearsOutliersByItsHuberNorm) {
  SceneOptions scene_options = RowOfSix();
  scene_options.num_points = 300;
  scene_options.noise_px = 0.3;
  scene_options.outlier_ratio = 0.1;
  BundleProblem truth = MakeProblem(MakeScene(scene_options));
  FixFirstTwo(&truth);

  BundleProblem robust = truth;
  ASSERT_TRUE(Solve({}, &robust).is_usable);
  EXPECT_LT(LargestCenterError(robust, truth), 0.02);

  BundleOptions least_squares;
  least_squares.huber_width_px = 1e6;
  BundleProblem pulled = truth;
  Solve(least_squares, &pulled);
  EXPECT_GT(LargestCenterError(pulled, truth), 10.0 * LargestCenterError(robust, truth));
}

TEST(SolveBundle, GivesMoreToObservationsOfGreaterWeight) {
  const Scene scene = MakeScene(RowOfSix());
  BundleProblem problem = MakeProblem(scene);
  for (BundleView& view : problem.views) view.is_fixed = true;
  BundleObservation& moved = problem.observations[0];
  moved.pixel.x() += 1.0;
  const auto error_px = [&](double weight) {
    BundleProblem weighted = problem;
    weighted.observations[0].weight = weight;
    EXPECT_TRUE(Solve({}, &weighted).is_usable);
    const BundleView& view = weighted.views[moved.view_idx];
    const BundleLandmark& landmark = weighted.landmarks[moved.landmark_idx];
    return (*scene.camera.Project(view.cam_from_map * landmark.position_in_map) - moved.pixel)
        .norm();
  };
  EXPECT_LT(error_px(1.0), 0.99 * error_px(0.2));
}

TEST(SolveBundle, HoldsTheLensUnlessToldToRefineIt) {
  BundleProblem problem = MakeProblem(MakeScene(RowOfSix()));
  problem.lens[kFx] *= 1.01;
  const LensParameters<double> start = problem.lens;
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  EXPECT_EQ(problem.lens, start);
}

// Turned about the optical axis, views tell the principal point; from several distances, the
// focal length.
BundleProblem LensProblem() {
  SceneOptions options;
  options.num_points = 300;
  options.num_cameras = 8;
  options.approach_m = 0.5;
  options.max_turn_rad = 0.5;
  options.relief_m = 2.0;
  options.camera = test::MakeCamera(-0.1, 0.03, 0.001, -0.0005);
  return MakeProblem(MakeScene(options));
}

TEST(SolveBundle, RefinesFocalLengthAndDistortionFromAWrongStart) {
  const BundleProblem truth = LensProblem();
  BundleProblem problem = truth;
  problem.lens[kFx] *= 1.01;
  problem.lens[kFy] *= 1.01;
  problem.lens[kK1] = 0.0;
  problem.lens[kK2] = 0.0;
  problem.lens[kP1] = 0.0;
  BundleOptions options;
  options.refine_focal_length = true;
  options.refine_distortion = true;
  ASSERT_TRUE(Solve(options, &problem).is_usable);
  EXPECT_NEAR(problem.lens[kFx], truth.lens[kFx], 1e-3);
  EXPECT_NEAR(problem.lens[kFy], truth.lens[kFy], 1e-3);
  for (const int k : {kK1, kK2, kP1, kP2, kK3}) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_NEAR(problem.lens[i], truth.lens[i], 1e-6) << "parameter " << k;
  }
  EXPECT_EQ(problem.lens[kCx], truth.lens[kCx]);  // Held.
  EXPECT_EQ(problem.lens[kCy], truth.lens[kCy]);
}

TEST(SolveBundle, RefinesThePrincipalPointAlone) {
  const BundleProblem truth = LensProblem();
  BundleProblem problem = truth;
  problem.lens[kCx] += 8.0;
  problem.lens[kCy] -= 5.0;
  BundleOptions options;
  options.refine_principal_point = true;
  ASSERT_TRUE(Solve(options, &problem).is_usable);
  EXPECT_NEAR(problem.lens[kCx], truth.lens[kCx], 1e-3);
  EXPECT_NEAR(problem.lens[kCy], truth.lens[kCy], 1e-3);
  EXPECT_EQ(problem.lens[kFx], truth.lens[kFx]);
  EXPECT_EQ(problem.lens[kK1], truth.lens[kK1]);
}

TEST(SolveBundle, WhenCancelledLeavesTheProblemAsItIs) {
  BundleProblem problem = MakeProblem(MakeScene(RowOfSix()));
  Disturb(0.02, 0.1, &problem);
  const BundleProblem before = problem;
  const std::atomic<bool> cancel{true};
  EXPECT_FALSE(SolveBundle({}, kManyIterations, kTolerance, &cancel, &problem).is_usable);
  EXPECT_EQ(LargestDistance(problem, before), 0.0);
  EXPECT_EQ(LargestTurn(problem, before), 0.0);
}

TEST(SolveBundle, OfNothingIsNotUsable) {
  BundleProblem problem;
  EXPECT_FALSE(Solve({}, &problem).is_usable);
}

TEST(SolveBundle, RefusesBadOptions) {
  BundleProblem problem = MakeProblem(MakeScene(RowOfSix()));
  BundleOptions options;
  options.huber_width_px = 0.0;
  EXPECT_THROW(Solve(options, &problem), std::invalid_argument);
}

TEST(SolveBundle, OfSixtyAndMoreViewsAgreesWithThatOfFewer) {  // Another linear solver.
  SceneOptions options;
  options.num_points = 120;
  options.num_cameras = 64;
  options.spacing_m = 0.2;
  const BundleProblem truth = MakeProblem(MakeScene(options));
  BundleProblem problem = truth;
  FixFirstTwo(&problem);
  Disturb(0.02, 0.05, &problem);
  ASSERT_TRUE(Solve({}, &problem).is_usable);
  EXPECT_LT(LargestDistance(problem, truth), 1e-5);
}

}  // namespace
}  // namespace plumb
