// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/alignment.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::Random;

using Points = std::vector<Eigen::Vector3d>;

Similarity3 MakeSimilarity(int seed) {
  const Rigid3 rigid = Random(seed).Pose(50.0);
  return {2.5, rigid.rotation, rigid.translation};
}

Points RandomPoints(int count, Random* random) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(random->InBox(10.0));
  return points;
}

Points Transformed(const Similarity3& target_from_source, const Points& points) {
  Points transformed;
  for (const Eigen::Vector3d& point : points) transformed.push_back(target_from_source * point);
  return transformed;
}

double SumOfSquares(const Similarity3& target_from_source,
                    const Points& source,
                    const Points& target) {
  double sum = 0.0;
  for (const double residual : AlignmentResiduals(target_from_source, source, target)) {
    sum += residual * residual;
  }
  return sum;
}

TEST(AlignPoints, FindsTheExactSimilarity) {
  Random random(1);
  const Points source = RandomPoints(20, &random);
  const Similarity3 truth = MakeSimilarity(2);
  const auto found = AlignPoints(source, Transformed(truth, source));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, truth.scale, 1e-12);
  EXPECT_LT(found->rotation.angularDistance(truth.rotation), 1e-7);
  EXPECT_LT((found->translation - truth.translation).norm(), 1e-11);
}

TEST(AlignPoints, IsLeastSquaresUnderNoise) {  // Brute force: no neighbour is better.
  Random random(3);
  const Points source = RandomPoints(15, &random);
  Points target = Transformed(MakeSimilarity(4), source);
  for (Eigen::Vector3d& point : target) point += random.InBox(0.5);
  const auto found = AlignPoints(source, target);
  ASSERT_TRUE(found);
  const double best = SumOfSquares(*found, source, target);
  for (int trial = 0; trial < 100; ++trial) {
    Similarity3 other = *found;
    other.scale += random.Normal(1e-3);
    other.translation += 1e-2 * random.InBox(1.0);
    other.rotation =
        Eigen::Quaterniond(Eigen::AngleAxisd(random.Normal(1e-3), random.InBox(1.0).normalized())) *
        other.rotation;
    EXPECT_LT(best, SumOfSquares(other, source, target));
  }
}

TEST(AlignPoints, WorksOnAPlaneWithoutMirroring) {
  Random random(5);
  Points source = RandomPoints(4, &random);
  for (Eigen::Vector3d& point : source) point.z() = 0.0;
  const Similarity3 truth = MakeSimilarity(6);
  const auto found = AlignPoints(source, Transformed(truth, source));
  ASSERT_TRUE(found);
  EXPECT_LT(found->rotation.angularDistance(truth.rotation), 1e-6);
}

TEST(AlignPoints, KeepsItsDigitsInLargeCoordinates) {
  Random random(7);
  const Points source = RandomPoints(10, &random);
  Similarity3 truth = MakeSimilarity(8);
  truth.translation += Eigen::Vector3d(5e5, 6e6, 300.0);  // UTM.
  const Points target = Transformed(truth, source);
  const auto found = AlignPoints(source, target);
  ASSERT_TRUE(found);
  for (const double residual : AlignmentResiduals(*found, source, target)) {
    EXPECT_LT(residual, 1e-7);
  }
}

TEST(AlignPoints, FindsNothingForTooFewOrCollinearPoints) {
  Random random(9);
  const Points two = RandomPoints(2, &random);
  EXPECT_FALSE(AlignPoints(two, two));
  EXPECT_FALSE(AlignPoints({}, {}));
  Points line;
  for (int i = 0; i < 10; ++i) line.push_back(Eigen::Vector3d(1.0, 2.0, 3.0) * i);
  const Points cloud = RandomPoints(10, &random);
  EXPECT_FALSE(AlignPoints(line, cloud));
  EXPECT_FALSE(AlignPoints(cloud, line));
  EXPECT_FALSE(AlignPoints(Points(5, {1.0, 2.0, 3.0}), Points(5, {1.0, 2.0, 3.0})));
}

TEST(AlignPoints, RefusesUnequalLengths) {
  EXPECT_THROW(AlignPoints({{0, 0, 0}}, {}), std::logic_error);
  EXPECT_THROW(AlignmentResiduals({}, {{0, 0, 0}}, {}), std::logic_error);
}

TEST(AlignmentResiduals, AreDistancesInTheTarget) {
  Similarity3 doubled;
  doubled.scale = 2.0;
  const auto residuals =
      AlignmentResiduals(doubled, {{1, 0, 0}, {0, 1, 0}}, {{2, 0, 0}, {0, 2, 3}});
  ASSERT_EQ(residuals.size(), 2u);
  EXPECT_DOUBLE_EQ(residuals[0], 0.0);
  EXPECT_DOUBLE_EQ(residuals[1], 3.0);
}

}  // namespace
}  // namespace plumb
