// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/triangle_mesh.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/evaluation/test_surfaces.h"

namespace plumb {
namespace {

// 3 m^2, 1 m^2 and, between them, one without area.
TriangleMesh MakeUnequalMesh() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {3, 4, 5}};
  return mesh;
}

TEST(SampleSurface, SpreadsPointsByArea) {
  const TriangleMesh mesh = MakeUnequalMesh();
  int num_in_large = 0;
  for (const SurfaceSample& sample : SampleSurface(mesh, 4000, 1)) {
    ASSERT_NE(sample.triangle_idx, 1u);
    const bool is_large = sample.triangle_idx == 0;
    num_in_large += is_large ? 1 : 0;
    ASSERT_NEAR(sample.point.z(), is_large ? 0.0 : 5.0, 1e-12);
    ASSERT_GE(sample.point.head<2>().minCoeff(), 0.0);
    ASSERT_LE(sample.point.x() / 2.0 + sample.point.y() / (is_large ? 3.0 : 1.0), 1.0 + 1e-12);
  }
  EXPECT_EQ(num_in_large, 3000);  // Equal parts of the area: no chance in it.
}

TEST(SampleSurface, SpreadsPointsEvenlyWithinATriangle) {
  TriangleMesh mesh = MakeUnequalMesh();
  mesh.triangles.resize(1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SurfaceSample& sample : SampleSurface(mesh, 40000, 7)) sum += sample.point;
  EXPECT_LT((sum / 40000.0 - Eigen::Vector3d(2.0 / 3.0, 1.0, 0.0)).norm(), 0.02);
}

TEST(SampleSurface, GivesTheSamePointsForTheSameSeed) {
  const TriangleMesh mesh = MakeUnequalMesh();
  const auto samples = SampleSurface(mesh, 100, 3);
  const auto again = SampleSurface(mesh, 100, 3);
  const auto others = SampleSurface(mesh, 100, 4);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(samples[i].point, again[i].point);
    EXPECT_NE(samples[i].point, others[i].point);
  }
}

TEST(SampleSurface, RefusesAMeshWithoutArea) {
  TriangleMesh mesh = MakeUnequalMesh();
  mesh.triangles = {{0, 0, 1}};
  EXPECT_THROW(SampleSurface(mesh, 10, 1), std::invalid_argument);
  mesh.triangles.clear();
  EXPECT_THROW(SampleSurface(mesh, 10, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumb
