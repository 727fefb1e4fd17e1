// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "test/evaluation/test_surfaces.h"
#include "test/support/random.h"

namespace plumb {
namespace {

TEST(MeshIndex, GivesTheKnownDistanceToAWallItsEdgeAndItsCorner) {
  const MeshIndex index(test::MakeWall());
  EXPECT_NEAR(index.NearestTo({4, -0.003, 5}).distance, 0.003, 1e-12);
  EXPECT_LT(index.NearestTo({4, -0.003, 5}).triangle_idx, 2u);
  EXPECT_NEAR(index.NearestTo({4, -0.5, -0.02}).distance, 0.02, 1e-12);
  EXPECT_GE(index.NearestTo({4, -0.5, -0.02}).triangle_idx, 2u);
  EXPECT_NEAR(index.NearestTo({10, 3, 14}).distance, 5.0, 1e-12);
  EXPECT_NEAR(index.NearestTo({22, 3, 16}).distance, 7.0, 1e-12);
}

TEST(MeshIndex, MeasuresASphereToItsFlattening) {
  const MeshIndex index(test::MakeSphere(2.0, 100));
  // The middle of a face lies below the sphere by up to r (1 - cos(edge angle)).
  const double flattening = 2.0 * (1.0 - std::cos(M_PI / 100.0));
  test::Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d point = random.InBox(3.0);
    EXPECT_NEAR(index.NearestTo(point).distance, std::abs(point.norm() - 2.0), flattening);
  }
}

TEST(MeshIndex, IsExactInLargeCoordinates) {
  TriangleMesh mesh = test::MakeWall();
  const Eigen::Vector3d utm(500'000.0, 5'000'000.0, 400.0);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex += utm;
  const Eigen::Vector3d point = utm + Eigen::Vector3d(4, -0.001, 5);
  EXPECT_NEAR(MeshIndex(mesh).NearestTo(point).distance, 0.001, 1e-8);
}

TEST(MeshIndex, LeavesOutTrianglesWithoutArea) {
  TriangleMesh mesh = test::MakeWall();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  EXPECT_EQ(MeshIndex(mesh).NearestTo({4, -0.5, 0}).triangle_idx, 3u);
  mesh.triangles.resize(1);
  EXPECT_THROW(MeshIndex{mesh}, std::invalid_argument);
}

TEST(MeshIndex, BlocksWhatCrossesIt) {
  const MeshIndex index(test::MakeWall());
  EXPECT_TRUE(index.Blocks({5, -2, 5}, {5, 2, 5}));
  EXPECT_FALSE(index.Blocks({5, -2, 5}, {5, -0.01, 5}));
  EXPECT_FALSE(index.Blocks({25, -2, 5}, {25, 2, 5}));
}

TEST(CloudIndex, AgreesWithBruteForce) {
  test::Random random(2);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 1000; ++i) points.push_back(random.InBox(1.0));
  const CloudIndex index(points);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d query = random.InBox(1.5);
    double nearest = 1e9;
    for (const auto& point : points) nearest = std::min(nearest, (point - query).norm());
    EXPECT_NEAR(index.DistanceTo(query), nearest, 1e-12);
    EXPECT_LE(index.DistanceToSurface(query), nearest);
  }
}

// A scan of the plane y = 0: every 15 mm a point.
std::vector<Eigen::Vector3d> ScanPlane(double noise_m) {
  test::Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) points.emplace_back(0.015 * i, random.Normal(noise_m), 0.015 * k);
  }
  return points;
}

TEST(CloudIndex, MeasuresToTheScannedSurfaceNotToTheNextPoint) {
  const CloudIndex index(ScanPlane(0.0));
  const Eigen::Vector3d between(33.5 * 0.015, 0.003, 33.5 * 0.015);
  EXPECT_NEAR(index.DistanceTo(between), std::hypot(0.0075, 0.0075, 0.003), 1e-12);
  EXPECT_NEAR(index.DistanceToSurface(between), 0.003, 1e-12);
}

TEST(CloudIndex, AveragesTheScansNoise) {
  const CloudIndex index(ScanPlane(0.002));
  test::Random random(4);
  double sum_of_squares = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d point(random.Uniform(0.1, 1.3), 0.0, random.Uniform(0.1, 1.3));
    sum_of_squares += std::pow(index.DistanceToSurface(point), 2);
  }
  EXPECT_LT(std::sqrt(sum_of_squares / 1000.0), 0.0012);  // 2 mm, by the root of eight, and tilt.
}

TEST(CloudIndex, DoesNotExtendTheSurfaceBeyondTheScan) {
  const CloudIndex index(ScanPlane(0.0));
  EXPECT_NEAR(index.DistanceToSurface({-0.5, 0.0, 0.75}), 0.5, 1e-12);
}

TEST(CloudIndex, TakesFewPointsAndRefusesNone) {
  EXPECT_NEAR(CloudIndex({{0, 0, 0}}).DistanceToSurface({3, 4, 0}), 5.0, 1e-12);
  EXPECT_THROW(CloudIndex({}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
