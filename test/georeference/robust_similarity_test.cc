// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/robust_similarity.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "test/support/random.h"

namespace plumb {
namespace {

using Status = RobustSimilarity::Status;

Similarity3 MakeTargetFromSource() {
  return {7.3,
          Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, -1).normalized())),
          {100.0, -50.0, 20.0}};
}

// Points over a facade of 50 m x 30 m, each axis with noise in the target [m].
std::vector<PointPair> MakePairs(int count, double sigma_m, int seed = 1) {
  test::Random random(seed);
  const Similarity3 source_from_target = MakeTargetFromSource().Inverse();
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(0.0, 50.0);
    const double y = random.Uniform(0.0, 0.5);
    const Eigen::Vector3d truth(x, y, random.Uniform(0.0, 30.0));
    const double dx = random.Normal(sigma_m);
    const double dy = random.Normal(sigma_m);
    PointPair pair;
    pair.in_source = source_from_target * truth;
    pair.in_target = truth + Eigen::Vector3d(dx, dy, random.Normal(sigma_m));
    pair.target_covariance = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<int> BadOf(const RobustSimilarity& similarity) {
  std::vector<int> bad;
  for (std::size_t i = 0; i < similarity.is_good.size(); ++i) {
    if (similarity.is_good[i] == 0) bad.push_back(static_cast<int>(i));
  }
  return bad;
}

TEST(EstimateRobustSimilarity, FindsTheTruthWithoutNoise) {
  const RobustSimilarity similarity = EstimateRobustSimilarity({}, MakePairs(12, 0.0));
  ASSERT_EQ(similarity.status, Status::kOk);
  EXPECT_NEAR(similarity.target_from_source.scale, 7.3, 1e-9);
  EXPECT_LT(similarity.target_from_source.rotation.angularDistance(MakeTargetFromSource().rotation),
            1e-7);
  EXPECT_TRUE(BadOf(similarity).empty());
  EXPECT_EQ(similarity.bend_sigma, 0.0);
  EXPECT_FALSE(similarity.is_ambiguous);
}

TEST(EstimateRobustSimilarity, FindsThreeWrongOfSeventeen) {
  // As they happen: two exchanged, one moved by half a metre.
  for (int seed = 1; seed <= 20; ++seed) {
    std::vector<PointPair> pairs = MakePairs(17, 0.002, seed);
    std::swap(pairs[3].in_target, pairs[11].in_target);
    pairs[8].in_target += Eigen::Vector3d(0.3, 0.0, 0.4);
    const RobustSimilarity similarity = EstimateRobustSimilarity({}, pairs);
    ASSERT_EQ(similarity.status, Status::kOk) << seed;
    EXPECT_EQ(BadOf(similarity), (std::vector<int>{3, 8, 11})) << seed;
    EXPECT_NEAR(similarity.target_from_source.scale / 7.3, 1.0, 2e-4) << seed;
  }
}

TEST(EstimateRobustSimilarity, FindsASmallMoveInAStraightMap) {
  // 40 mm, which a bent map of 58 m may have, but this one is true to 2 mm.
  for (int seed = 1; seed <= 10; ++seed) {
    std::vector<PointPair> pairs = MakePairs(17, 0.002, seed);
    pairs[8].in_target.y() += 0.04;
    EXPECT_EQ(BadOf(EstimateRobustSimilarity({}, pairs)), (std::vector<int>{8})) << seed;
  }
}

TEST(EstimateRobustSimilarity, AccusesNobodyOfNoise) {
  int num_accused = 0;
  for (int seed = 1; seed <= 100; ++seed) {
    num_accused +=
        static_cast<int>(BadOf(EstimateRobustSimilarity({}, MakePairs(12, 0.002, seed))).size());
  }
  EXPECT_EQ(num_accused, 0);
}

TEST(EstimateRobustSimilarity, TakesABentMapAsItIs) {
  // A dome of 25 mm at the ends, as the paper's flights at 4 m have it.
  std::vector<PointPair> pairs = MakePairs(17, 0.001);
  const Similarity3 source_from_target = MakeTargetFromSource().Inverse();
  for (PointPair& pair : pairs) {
    Eigen::Vector3d bent = MakeTargetFromSource() * pair.in_source;
    bent.y() += 0.025 * std::pow((bent.x() - 25.0) / 25.0, 2);
    pair.in_source = source_from_target * bent;
  }
  const RobustSimilarity similarity = EstimateRobustSimilarity({}, pairs);
  ASSERT_EQ(similarity.status, Status::kOk);
  EXPECT_TRUE(BadOf(similarity).empty());
  EXPECT_GT(similarity.bend_sigma, 0.002);
  EXPECT_LT(similarity.bend_sigma, 0.010);
}

TEST(EstimateRobustSimilarity, MeasuresTheBend) {
  // 10 mm on each axis that no covariance knows of.
  double sum = 0.0;
  for (int seed = 1; seed <= 30; ++seed) {
    std::vector<PointPair> pairs = MakePairs(30, 0.010, seed);
    for (PointPair& pair : pairs) pair.target_covariance.setZero();
    sum += EstimateRobustSimilarity({}, pairs).bend_sigma / 30.0;
  }
  EXPECT_NEAR(sum, 0.010, 0.0005);
}

TEST(EstimateRobustSimilarity, SaysHowSureItIs) {
  // Squared normalised error of the points that were not adjusted to: mean 3.
  double sum = 0.0;
  constexpr int kDraws = 300;
  const Eigen::Vector3d corner(50.0, 0.0, 0.0);
  const Eigen::Vector3d in_source = MakeTargetFromSource().Inverse() * corner;
  for (int seed = 1; seed <= kDraws; ++seed) {
    const RobustSimilarity similarity = EstimateRobustSimilarity({}, MakePairs(10, 0.003, seed));
    const Eigen::Vector3d error = similarity.target_from_source * in_source - corner;
    sum += error.dot(CovarianceAt(similarity, in_source).inverse() * error);
  }
  EXPECT_NEAR(sum / kDraws, 3.0, 0.6);
}

TEST(EstimateRobustSimilarity, WeighsPairsByTheirCovariance) {
  std::vector<PointPair> pairs = MakePairs(10, 0.001);
  pairs[0].in_target.x() += 0.05;
  pairs[0].target_covariance = 0.04 * 0.04 * Eigen::Matrix3d::Identity();
  const RobustSimilarity similarity = EstimateRobustSimilarity({}, pairs);
  EXPECT_TRUE(BadOf(similarity).empty());
  const Eigen::Vector3d middle(25.0, 0.0, 15.0);
  const Eigen::Vector3d seen =
      similarity.target_from_source * (MakeTargetFromSource().Inverse() * middle);
  EXPECT_LT((seen - middle).norm(), 0.002);
}

TEST(EstimateRobustSimilarity, NeedsThreePairsBesideALine) {
  std::vector<PointPair> pairs = MakePairs(8, 0.0);
  EXPECT_EQ(EstimateRobustSimilarity({}, {}).status, Status::kTooFewPairs);
  EXPECT_EQ(EstimateRobustSimilarity({}, {pairs[0], pairs[1]}).status, Status::kTooFewPairs);
  EXPECT_EQ(EstimateRobustSimilarity({}, {pairs[0], pairs[1], pairs[2]}).status, Status::kOk);
  const Similarity3 source_from_target = MakeTargetFromSource().Inverse();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].in_target = {5.0 * static_cast<double>(i), 0.0, i % 2 == 0 ? 0.0 : 0.1};
    pairs[i].in_source = source_from_target * pairs[i].in_target;
  }
  EXPECT_EQ(EstimateRobustSimilarity({}, pairs).status, Status::kCollinear);
}

TEST(EstimateRobustSimilarity, RefusesWhenMostDisagree) {
  test::Random random(1);
  std::vector<PointPair> pairs = MakePairs(9, 0.001);
  for (std::size_t i = 0; i < 6; ++i) pairs[i].in_target += random.InBox(10.0);
  EXPECT_EQ(EstimateRobustSimilarity({}, pairs).status, Status::kNoAgreement);
  pairs.resize(3);  // Three that contradict each other.
  EXPECT_EQ(EstimateRobustSimilarity({}, pairs).status, Status::kNoAgreement);
}

TEST(EstimateRobustSimilarity, SaysWhenWhichOnesAreWrongIsNotCertain) {
  // A square whose fourth corner was moved so that it and the mirrored third still fit the others.
  std::vector<PointPair> pairs(4);
  pairs[0].in_source = {0, 0, 0};
  pairs[1].in_source = {10, 0, 0};
  pairs[2].in_source = {5, 0, 8};
  pairs[3].in_source = {5, 0, -8};
  for (PointPair& pair : pairs) pair.in_target = pair.in_source;
  pairs[3].in_target = {5, 8, 0};  // As far from 0 and 1 as before, but turned about their line.
  const RobustSimilarity similarity = EstimateRobustSimilarity({}, pairs);
  ASSERT_EQ(similarity.status, Status::kOk);
  EXPECT_EQ(BadOf(similarity).size(), 1U);
  EXPECT_TRUE(similarity.is_ambiguous);
}

TEST(EstimateRobustSimilarity, DrawsTheSameTriplesAgain) {
  std::vector<PointPair> pairs = MakePairs(60, 0.5);
  for (std::size_t i = 0; i < 15; ++i) pairs[i].in_target.z() += 20.0;
  RobustSimilarityOptions options;
  options.max_bend_ratio = 0.0;
  const RobustSimilarity first = EstimateRobustSimilarity(options, pairs);
  const RobustSimilarity again = EstimateRobustSimilarity(options, pairs);
  ASSERT_EQ(first.status, Status::kOk);
  EXPECT_EQ(BadOf(first).size(), 15U);
  EXPECT_EQ(first.target_from_source.scale, again.target_from_source.scale);
}

}  // namespace
}  // namespace plumb
