// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/distance_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plumbline/evaluation/nearest.h"
#include "test/evaluation/test_surfaces.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(SummariseDistances, MatchesFiguresByHand) {
  const DistanceSummary summary =
      SummariseDistances({0.030, 0.0005, 0.001, 0.004, 0.0015, 0.002, 0.003, 0.006, 0.015, 0.009});
  EXPECT_EQ(summary.num_points, 10u);
  EXPECT_NEAR(summary.mean_mm, 7.2, 1e-9);
  EXPECT_NEAR(summary.median_mm, 3.5, 1e-9);
  EXPECT_NEAR(summary.rms_mm, std::sqrt(127.45), 1e-9);
  EXPECT_NEAR(summary.p90_mm, 15.0, 1e-9);
  EXPECT_NEAR(summary.max_mm, 30.0, 1e-9);
  EXPECT_THAT(
      summary.share_within,
      ElementsAre(DoubleEq(0.2), DoubleEq(0.4), DoubleEq(0.6), DoubleEq(0.8), DoubleEq(0.9)));
}

TEST(SummariseDistances, OfNothingIsZero) {
  EXPECT_EQ(SummariseDistances({}).num_points, 0u);
  EXPECT_EQ(SummariseDistances({}).share_within[4], 0.0);
}

TEST(SummariseDistances, MeasuresPointsOffAWallByAKnownDistanceBothWays) {
  // Half of the wall is reconstructed: nine tenths of its points 1.5 mm before it, the rest 8 mm.
  const TriangleMesh wall = test::MakeWall();
  std::vector<Eigen::Vector3d> points;
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) {
      points.emplace_back(0.1 * i + 0.05, k % 10 == 0 ? -0.008 : -0.0015, 0.1 * k + 0.05);
    }
  }
  const MeshIndex truth(wall);
  const DistanceSummary accuracy = SummariseDistances(EvaluateAtPoints(
      points, [&](const Eigen::Vector3d& point) { return truth.NearestTo(point).distance; }));
  EXPECT_NEAR(accuracy.median_mm, 1.5, 1e-9);
  EXPECT_NEAR(accuracy.mean_mm, 0.9 * 1.5 + 0.1 * 8.0, 1e-9);
  EXPECT_NEAR(accuracy.p90_mm, 1.5, 1e-9);
  EXPECT_NEAR(accuracy.max_mm, 8.0, 1e-9);
  EXPECT_THAT(accuracy.share_within, ElementsAre(0.0, 0.9, 0.9, 1.0, 1.0));

  std::vector<Eigen::Vector3d> samples;
  for (const SurfaceSample& sample : SampleSurface(wall, 220'000, 1)) {
    samples.push_back(sample.point);
  }
  const CloudIndex reconstructed(points);
  const DistanceSummary completeness = SummariseDistances(EvaluateAtPoints(
      samples, [&](const Eigen::Vector3d& sample) { return reconstructed.DistanceTo(sample); }));
  // Of 220 m^2, within 20 mm: a disc about each point, its radius^2 = 20^2 - offset^2.
  const double area_m2 = M_PI * (9000 * (4e-4 - 2.25e-6) + 1000 * (4e-4 - 64e-6));
  EXPECT_NEAR(completeness.share_within[4], area_m2 / 220.0, 0.001);
  EXPECT_NEAR(FScore(accuracy, completeness)[4], 2.0 * area_m2 / (220.0 + area_m2), 0.002);
  EXPECT_EQ(FScore(accuracy, completeness)[0], 0.0);
}

TEST(SummariseDistances, FindsAMeshOnItself) {  // Law: a surface lies on itself.
  const TriangleMesh sphere = test::MakeSphere(3.0, 40);
  const MeshIndex index(sphere);
  std::vector<Eigen::Vector3d> points;
  for (const SurfaceSample& sample : SampleSurface(sphere, 5000, 2)) points.push_back(sample.point);
  const DistanceSummary summary = SummariseDistances(EvaluateAtPoints(
      points, [&](const Eigen::Vector3d& point) { return index.NearestTo(point).distance; }));
  EXPECT_LT(summary.max_mm, 1e-9);
  EXPECT_EQ(summary.share_within[0], 1.0);
}

}  // namespace
}  // namespace plumb
