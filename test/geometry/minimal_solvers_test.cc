// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/cubic.h"
#include "geometry/epipolar.h"
#include "geometry/five_point.h"
#include "geometry/homography.h"
#include "geometry/real_roots.h"
#include "geometry/sampler.h"
#include "plumbline/geometry/relative_pose.h"
#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

using test::Random;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

// Coefficients, lowest first, of lead * product (x - root) * (x^2 + 1)^(rest of the degree).
std::array<double, kRootsDegree + 1> FromRoots(const std::vector<double>& roots, double lead) {
  std::array<double, kRootsDegree + 1> c = {lead};
  int degree = 0;
  const auto multiply = [&](double linear, double constant, int by_degree) {
    std::array<double, kRootsDegree + 1> product = {};
    for (int i = 0; i <= degree; ++i) {
      product[i] += constant * c[i];
      product[i + 1] += linear * c[i];
      if (by_degree == 2) product[i + 2] += c[i];
    }
    c = product;
    degree += by_degree;
  };
  for (const double root : roots) multiply(1.0, -root, 1);
  while (degree + 2 <= kRootsDegree) multiply(0.0, 1.0, 2);
  return c;
}

TEST(RealRoots, FindsTheRealOnesInOrder) {
  EXPECT_THAT(RealRoots(FromRoots({3.0, -2.0, 0.5, 100.0}, -7.0)),
              ElementsAre(DoubleNear(-2.0, 1e-10),
                          DoubleNear(0.5, 1e-10),
                          DoubleNear(3.0, 1e-10),
                          DoubleNear(100.0, 1e-8)));
  EXPECT_EQ(RealRoots(FromRoots({-5, -4, -3, -2, -1, 1, 2, 3, 4, 5}, 1.0)).size(), 10u);
}

TEST(RealRoots, FindsNoneWhereThereIsNone) {
  EXPECT_TRUE(RealRoots(FromRoots({}, 2.0)).empty());
  EXPECT_TRUE(RealRoots({}).empty());
}

TEST(BestRealRoot, SolvesCubicsOfEveryShape) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<double, 4> c;
    for (double& value : c) value = random.Normal(1.0);
    if (trial % 4 == 1) c[3] = 0.0;
    if (trial % 4 == 2) c[0] = 0.0;
    if (trial % 8 == 7) c[0] = c[3] = 0.0;
    const auto root = BestRealRoot(c);
    ASSERT_TRUE(root);
    const double n = root->numerator;
    const double d = root->denominator;
    EXPECT_NEAR(
        c[0] * d * d * d + c[1] * n * d * d + c[2] * n * n * d + c[3] * n * n * n, 0.0, 1e-13);
    EXPECT_NEAR(std::hypot(n, d), 1.0, 1e-14);
  }
  EXPECT_FALSE(BestRealRoot({}));
}

std::vector<NormalizedMatch> RandomMatches(const Rigid3& cam2_from_cam1,
                                           bool is_planar,
                                           int count,
                                           Random* random) {
  std::vector<NormalizedMatch> matches;
  while (static_cast<int>(matches.size()) < count) {
    Eigen::Vector3d point = random->InBox(2.0) + Eigen::Vector3d(0.0, 0.0, 6.0);
    if (is_planar) point.z() = 6.0 + 0.2 * point.x() - 0.1 * point.y();
    const Eigen::Vector3d in_cam2 = cam2_from_cam1 * point;
    if (in_cam2.z() < 0.5) continue;
    matches.push_back({point.hnormalized(), in_cam2.hnormalized()});
  }
  return matches;
}

// A camera beside the first that looks the same way within some 15 degrees.
Rigid3 RandomNeighbor(Random* random) {
  const Eigen::Vector3d turn = random->InBox(0.15);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())),
          random->InBox(1.0).normalized()};
}

double EssentialDistance(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::min((a.normalized() - b.normalized()).norm(),
                  (a.normalized() + b.normalized()).norm());
}

// Distance of the nearest solution of a random sample from the truth; checks that every
// solution fits the five matches.
double NearestOfFivePoint(bool is_planar, Random* random) {
  const Rigid3 pose = RandomNeighbor(random);
  std::array<Eigen::Vector2d, 5> xy1;
  std::array<Eigen::Vector2d, 5> xy2;
  const auto matches = RandomMatches(pose, is_planar, 5, random);
  for (std::size_t i = 0; i < 5; ++i) {
    xy1[i] = matches[i].xy1;
    xy2[i] = matches[i].xy2;
  }
  double nearest = 2.0;
  for (const Eigen::Matrix3d& essential : SolveFivePoint(xy1, xy2)) {
    nearest = std::min(nearest, EssentialDistance(essential, EssentialFromPose(pose)));
    EXPECT_NEAR(essential.norm(), 1.0, 1e-12);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(xy2[i].homogeneous().dot(essential * xy1[i].homogeneous()), 0.0, 1e-12);
    }
  }
  return nearest;
}

TEST(SolveFivePoint, HasTheTrueEssentialMatrixAmongItsSolutions) {
  for (const bool is_planar : {false, true}) {
    Random random(7);
    int num_found = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      num_found += NearestOfFivePoint(is_planar, &random) < 1e-5 ? 1 : 0;
    }
    // Double roots, frequent near planes, lose half of the digits: a lost sample of many.
    EXPECT_GE(num_found, 980) << (is_planar ? "planar" : "general");
  }
}

TEST(PosesFromEssential, HoldsTheTrueOneAndAllGiveTheMatrix) {
  Random random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3 pose = RandomNeighbor(&random);
    const Eigen::Matrix3d essential = EssentialFromPose(pose);
    double nearest = 10.0;
    for (const Rigid3& candidate : PosesFromEssential(-3.0 * essential)) {
      EXPECT_LT(EssentialDistance(EssentialFromPose(candidate), essential), 1e-12);
      nearest = std::min(nearest, (candidate.Matrix() - pose.Matrix()).norm());
    }
    EXPECT_LT(nearest, 1e-7);
  }
}

TEST(MinimizeSampsonError, ReturnsToTheExactPose) {
  Random random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const Rigid3 pose = RandomNeighbor(&random);
    const auto matches = RandomMatches(pose, false, 40, &random);
    const Rigid3 disturbed(
        Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX())) * pose.rotation,
        (pose.translation + 0.1 * random.InBox(1.0)).normalized());
    const Rigid3 refined = MinimizeSampsonError(disturbed, matches, 1.0, 50);
    EXPECT_LT((refined.Matrix() - pose.Matrix()).norm(), 1e-7) << "trial " << trial;
  }
}

TEST(MinimizeSampsonError, EndsWhereTheNumericGradientVanishes) {
  Random random(12);
  const Rigid3 pose = RandomNeighbor(&random);
  auto matches = RandomMatches(pose, false, 200, &random);
  for (NormalizedMatch& match : matches) match.xy2 += random.Normal2(1e-3);
  const Rigid3 refined = MinimizeSampsonError(pose, matches, 1.0, 50);
  const auto cost_at = [&](int axis, double step) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(axis % 3)));
    const Rigid3 moved = axis < 3 ? Rigid3(turn * refined.rotation, refined.translation)
                                  : Rigid3(refined.rotation, turn * refined.translation);
    double cost = 0.0;
    for (const NormalizedMatch& match : matches) {
      cost += SquaredSampsonError(EssentialFromPose(moved), match.xy1, match.xy2);
    }
    return cost;
  };
  for (int axis = 0; axis < 6; ++axis) {
    const double slope = (cost_at(axis, 1e-5) - cost_at(axis, -1e-5)) / 2e-5;
    const double curvature =
        (cost_at(axis, 1e-3) + cost_at(axis, -1e-3) - 2.0 * cost_at(axis, 0.0)) / 1e-6;
    EXPECT_LT(std::abs(slope / curvature), 1e-5) << "axis " << axis;  // [rad] from the minimum.
  }
}

TEST(SigmasOf, AreTheSpreadOfRepeatedEstimates) {
  Random random(13);
  const Rigid3 pose = RandomNeighbor(&random);
  const auto exact = RandomMatches(pose, false, 100, &random);
  constexpr double kSigma = 1e-3;  // Of each coordinate, so of the Sampson error.
  const RelativePoseSigmas sigmas = SigmasOf(pose, exact, kSigma);
  double sum_turn2 = 0.0;
  double sum_direction2 = 0.0;
  constexpr int kNumTrials = 200;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    auto matches = exact;
    for (NormalizedMatch& match : matches) {
      match.xy1 += random.Normal2(kSigma);
      match.xy2 += random.Normal2(kSigma);
    }
    const Rigid3 refined = MinimizeSampsonError(pose, matches, 1.0, 50);
    sum_turn2 += std::pow(refined.rotation.angularDistance(pose.rotation), 2);
    sum_direction2 += (refined.translation - pose.translation).squaredNorm();
  }
  // The sums hold all axes, the sigmas the worst one: at most three and two times its square.
  const double turn = std::sqrt(sum_turn2 / kNumTrials);
  const double direction = std::sqrt(sum_direction2 / kNumTrials);
  EXPECT_GT(turn, 0.9 * sigmas.turn_rad);
  EXPECT_LT(turn, 1.1 * std::sqrt(3.0) * sigmas.turn_rad);
  EXPECT_GT(direction, 0.9 * sigmas.direction_rad);
  EXPECT_LT(direction, 1.1 * std::sqrt(2.0) * sigmas.direction_rad);
}

TEST(SolveHomography, MapsItsFourPointsAndTheRestOfThePlane) {
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    const auto matches = RandomMatches(RandomNeighbor(&random), true, 20, &random);
    const auto h = SolveHomography({matches[0], matches[1], matches[2], matches[3]});
    if (!h) continue;  // Three of the four nearly on a line.
    for (const NormalizedMatch& match : matches) {
      const Eigen::Vector2d mapped = (*h * match.xy1.homogeneous()).hnormalized();
      EXPECT_LT((mapped - match.xy2).norm(), 1e-7) << "trial " << trial;
    }
  }
}

TEST(SolveHomography, FindsNothingForThreePointsOnALineOrAPlaneSeenFromBehind) {
  const std::array<NormalizedMatch, 4> on_line = {NormalizedMatch{{0, 0}, {0, 0}},
                                                  {{0.1, 0.1}, {0.1, 0}},
                                                  {{0.2, 0.2}, {0.1, 0.1}},
                                                  {{0.3, 0.0}, {0, 0.1}}};
  EXPECT_FALSE(SolveHomography(on_line));
  // The fourth point crossed the side between the first two.
  const std::array<NormalizedMatch, 4> flipped = {NormalizedMatch{{0, 0}, {0, 0}},
                                                  {{0.1, 0}, {0.1, 0}},
                                                  {{0, 0.1}, {0, 0.1}},
                                                  {{0.1, 0.1}, {0.03, -0.1}}};
  EXPECT_FALSE(SolveHomography(flipped));
}

TEST(PosesFromHomography, HoldsTheTruePoseWhateverTheSign) {
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3 pose = RandomNeighbor(&random);
    const auto matches = RandomMatches(pose, true, 30, &random);
    const Eigen::Matrix3d h = RefineHomography(Eigen::Matrix3d::Identity(), matches);
    for (const double sign : {1.0, -1.0}) {
      double nearest = 10.0;
      for (const Rigid3& candidate : PosesFromHomography(sign * h)) {
        nearest = std::min(nearest, (candidate.Matrix() - pose.Matrix()).norm());
      }
      EXPECT_LT(nearest, 1e-5) << "trial " << trial;
    }
  }
}

TEST(Sampler, DrawsDistinctIndicesOfAllTheRange) {
  Sampler sampler(1);
  std::vector<int> counts(5, 0);
  for (int trial = 0; trial < 1000; ++trial) {
    auto indices = sampler.Distinct<3>(5);
    std::sort(indices.begin(), indices.end());
    EXPECT_GE(indices[0], 0);
    EXPECT_LT(indices[0], indices[1]);
    EXPECT_LT(indices[1], indices[2]);
    EXPECT_LT(indices[2], 5);
    for (const int index : indices) ++counts[static_cast<std::size_t>(index)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 600, 80);  // 5 standard deviations.
}

}  // namespace
}  // namespace plumb
