// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plumbline/geometry/rigid3.h"
#include "plumbline/geometry/similarity3.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::Random;

TEST(Rigid3, ComposesInvertsAndMapsConsistently) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Rigid3 c_from_b = random.Pose(3.0);
    const Rigid3 b_from_a = random.Pose(3.0);
    const Eigen::Vector3d point = random.InBox(5.0);
    EXPECT_LT(((c_from_b * b_from_a) * point - c_from_b * (b_from_a * point)).norm(), 1e-13);
    EXPECT_LT((c_from_b.Inverse() * (c_from_b * point) - point).norm(), 1e-13);
    EXPECT_LT((c_from_b.Matrix() * point.homogeneous() - c_from_b * point).norm(), 1e-13);
    EXPECT_LT((c_from_b * c_from_b.TargetOriginInSource()).norm(), 1e-13);
  }
}

TEST(Rigid3, NormalizesItsRotation) {
  const Rigid3 transform(Eigen::Quaterniond(2.0, 0.0, 0.0, 2.0), Eigen::Vector3d::Zero());
  EXPECT_DOUBLE_EQ(transform.rotation.norm(), 1.0);
}

TEST(Similarity3, InvertsConsistently) {
  Random random(2);
  const Rigid3 rigid = random.Pose(3.0);
  const Similarity3 target_from_source = {0.4, rigid.rotation, rigid.translation};
  const Eigen::Vector3d point = random.InBox(5.0);
  EXPECT_LT((target_from_source.Inverse() * (target_from_source * point) - point).norm(), 1e-13);
}

TEST(TransformCamera, KeepsWhatTheCameraSees) {
  Random random(3);
  const Rigid3 rigid = random.Pose(3.0);
  const Similarity3 target_from_source = {2.5, rigid.rotation, rigid.translation};
  const Rigid3 cam_from_source = random.Pose(3.0);
  const Rigid3 cam_from_target = TransformCamera(target_from_source, cam_from_source);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d point = random.InBox(5.0);
    const Eigen::Vector3d scaled = cam_from_target * (target_from_source * point);
    EXPECT_LT((scaled - 2.5 * (cam_from_source * point)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace plumb
