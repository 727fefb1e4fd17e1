// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/sight_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <vector>

#include "camera/lens_field.h"
#include "quality/sight.h"
#include "test/support/random.h"

namespace plumb {
namespace {

using internal::FaceArrays;
using internal::Lens;
using internal::Sight;
using internal::SightSums;

// No multiple of any number of lanes.
constexpr int kNumFaces = 1003;

Camera RationalCamera() {
  return Camera(
      "rational",
      4912,
      3264,
      DistortionModel::kRationalPolynomial,
      {3351.0, 3348.0, 2464.0, 1626.0, -0.07, 0.04, 4e-4, -3e-4, 0.01, 0.02, -0.01, 3e-3});
}

// Some are behind the camera, out of the photo, or turned away; one has no normal.
std::vector<FaceShape> RandomShapes(test::Random* random) {
  std::vector<FaceShape> shapes(kNumFaces);
  for (FaceShape& shape : shapes) {
    shape.center_in_map = random->InBox(6.0) + Eigen::Vector3d(0.0, 0.0, 5.0);
    shape.normal_in_map = random->InBox(1.0).normalized();
  }
  shapes[7].normal_in_map.setZero();
  return shapes;
}

Rigid3 TiltedPose() {
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()));
  return Rigid3(turn, Eigen::Vector3d(0.2, -0.4, 0.9));
}

Sight TiltedSight() { return Sight(std::make_shared<const Lens>(RationalCamera()), TiltedPose()); }

// By the lens's own code, a singular value decomposition, and no more than one face at a time.
Eigen::Matrix<double, 2, 3> TrueJacobian(const Camera& camera, const Eigen::Vector3d& in_map) {
  const Rigid3 pose = TiltedPose();
  const Eigen::Vector3d p = pose * in_map;
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << 1.0 / p.z(), 0.0, -p.x() / (p.z() * p.z()), 0.0, 1.0 / p.z(),
      -p.y() / (p.z() * p.z());
  const Eigen::Matrix2d by_xy = DistortWithJacobian(camera.lens(), p.hnormalized()).jacobian;
  const Eigen::Vector2d focal(camera.lens()[kFx], camera.lens()[kFy]);
  return focal.asDiagonal() * by_xy * by_point * pose.rotation.toRotationMatrix();
}

double TrueStretch(const Camera& camera, const FaceShape& shape) {
  const Rigid3 pose = TiltedPose();
  const auto pixel = camera.Project(pose * shape.center_in_map);
  const Eigen::Vector3d towards_eye = pose.TargetOriginInSource() - shape.center_in_map;
  if (!pixel || !camera.IsInImage(*pixel)) return 0.0;
  if (!(shape.normal_in_map.dot(towards_eye) > 0.0)) return 0.0;
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = shape.normal_in_map.unitOrthogonal();
  plane.col(1) = shape.normal_in_map.cross(plane.col(0));
  const Eigen::Matrix2d on_plane = TrueJacobian(camera, shape.center_in_map) * plane;
  return 1.0 / on_plane.jacobiSvd().singularValues()[1];
}

TEST(SightKernel, TellsWhatTheCameraTells) {
  test::Random random(3);
  const std::vector<FaceShape> shapes = RandomShapes(&random);
  std::vector<float> stretches(kNumFaces);
  FindStretches(TiltedSight().numbers(), FaceArrays(shapes), stretches.data());
  const Camera camera = RationalCamera();
  int num_shown = 0;
  for (int i = 0; i < kNumFaces; ++i) {
    const double expected = TrueStretch(camera, shapes[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(stretches[static_cast<std::size_t>(i)], expected, 1e-5 * expected) << i;
    num_shown += expected > 0.0 ? 1 : 0;
  }
  EXPECT_GT(num_shown, kNumFaces / 10);
  EXPECT_LT(num_shown, kNumFaces / 2);
}

TEST(SightKernel, AddsTheInformationOfWhatIsSeen) {
  test::Random random(4);
  const std::vector<FaceShape> shapes = RandomShapes(&random);
  const FaceArrays faces(shapes);
  std::vector<float> stretches(kNumFaces);
  FindStretches(TiltedSight().numbers(), faces, stretches.data());
  for (std::size_t i = 0; i < stretches.size(); i += 3) stretches[i] = -stretches[i];
  SightSums sums(kNumFaces);
  for (int photo = 0; photo < 2; ++photo) {
    AddSight(TiltedSight().numbers(), faces, stretches.data(), &sums);
  }
  const Camera camera = RationalCamera();
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    EXPECT_EQ(sums.num_seen[i], stretches[i] > 0.0F ? 2 : 0);
    EXPECT_EQ(sums.num_hidden[i], stretches[i] < 0.0F ? 2 : 0);
    if (sums.num_seen[i] == 0) {
      EXPECT_TRUE(std::isinf(sums.least_stretch[i]));
      EXPECT_EQ(sums.information[0][i], 0.0);
      continue;
    }
    EXPECT_EQ(sums.least_stretch[i], stretches[i]);
    const auto jacobian = TrueJacobian(camera, shapes[i].center_in_map);
    const Eigen::Matrix3d expected = 2.0 * jacobian.transpose() * jacobian;
    const double tolerance = 1e-9 * expected.norm();
    EXPECT_NEAR(sums.information[0][i], expected(0, 0), tolerance);
    EXPECT_NEAR(sums.information[1][i], expected(0, 1), tolerance);
    EXPECT_NEAR(sums.information[2][i], expected(0, 2), tolerance);
    EXPECT_NEAR(sums.information[3][i], expected(1, 1), tolerance);
    EXPECT_NEAR(sums.information[4][i], expected(1, 2), tolerance);
    EXPECT_NEAR(sums.information[5][i], expected(2, 2), tolerance);
  }
}

TEST(SightKernel, GivesTheSameBitsOnAllProcessors) {
  test::Random random(5);
  const FaceArrays faces(RandomShapes(&random));
  const Sight sight = TiltedSight();
  std::vector<float> expected(kNumFaces);
  FindStretches(sight.numbers(), faces, expected.data(), SimdLevel::kBaseline);
  SightSums expected_sums(kNumFaces);
  AddSight(sight.numbers(), faces, expected.data(), &expected_sums, SimdLevel::kBaseline);
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (level > DetectSimdLevel()) continue;
    std::vector<float> stretches(kNumFaces);
    FindStretches(sight.numbers(), faces, stretches.data(), level);
    EXPECT_EQ(stretches, expected);
    SightSums sums(kNumFaces);
    AddSight(sight.numbers(), faces, stretches.data(), &sums, level);
    EXPECT_EQ(sums.information, expected_sums.information);
    EXPECT_EQ(sums.least_stretch, expected_sums.least_stretch);
    EXPECT_EQ(sums.num_seen, expected_sums.num_seen);
    EXPECT_EQ(sums.num_hidden, expected_sums.num_hidden);
  }
}

}  // namespace
}  // namespace plumb
