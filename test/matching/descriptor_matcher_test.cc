// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/descriptor_matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "test/matching/random_descriptors.h"

namespace plumb {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::pair<int, int>> Match(const DescriptorMatrix& descriptors1,
                                       const DescriptorMatrix& descriptors2,
                                       double max_ratio = 0.8) {
  MatcherOptions options;
  options.max_ratio = max_ratio;
  std::vector<std::pair<int, int>> pairs;
  for (const FeatureMatch& match : MatchDescriptors(options, descriptors1, descriptors2)) {
    pairs.emplace_back(match.idx1, match.idx2);
  }
  return pairs;
}

// Descriptors that differ in their first element only, so that distances are plain differences.
DescriptorMatrix OnALine(const std::vector<int>& places) {
  DescriptorMatrix descriptors =
      DescriptorMatrix::Zero(static_cast<Eigen::Index>(places.size()), kDescriptorSize);
  for (std::size_t i = 0; i < places.size(); ++i) {
    descriptors(static_cast<Eigen::Index>(i), 0) = static_cast<std::uint8_t>(places[i]);
  }
  return descriptors;
}

TEST(MatchDescriptors, FindsAShuffledAndPerturbedCopy) {
  const DescriptorMatrix descriptors1 = RandomDescriptors(500, 1);
  const DescriptorMatrix descriptors2 = Perturbed(descriptors1, 3, 2).colwise().reverse();
  const auto pairs = Match(descriptors1, descriptors2);
  ASSERT_EQ(pairs.size(), 500U);
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(pairs[static_cast<std::size_t>(i)], std::make_pair(i, 499 - i));
  }
}

TEST(MatchDescriptors, OfNothingIsNothing) {
  const DescriptorMatrix nothing(0, kDescriptorSize);
  const DescriptorMatrix something = RandomDescriptors(3, 1);
  EXPECT_THAT(Match(nothing, something), IsEmpty());
  EXPECT_THAT(Match(something, nothing), IsEmpty());
  EXPECT_THAT(Match(nothing, nothing), IsEmpty());
}

TEST(MatchDescriptors, AppliesTheRatioToDistancesNotSquares) {
  // Distances 7 and 10: ratio 0.7; as squares it would be 0.49.
  EXPECT_THAT(Match(OnALine({100}), OnALine({107, 110}), 0.71), ElementsAre(std::pair(0, 0)));
  EXPECT_THAT(Match(OnALine({100}), OnALine({107, 110}), 0.69), IsEmpty());
}

TEST(MatchDescriptors, RefusesARatioThatIsMetExactly) {
  EXPECT_THAT(Match(OnALine({100}), OnALine({105, 110}), 0.5), IsEmpty());
}

TEST(MatchDescriptors, RefusesATieOfBestAndSecondBest) {
  EXPECT_THAT(Match(OnALine({100}), OnALine({110, 90}), 1.0), IsEmpty());
  EXPECT_THAT(Match(OnALine({100}), OnALine({100, 100}), 1.0), IsEmpty());
}

TEST(MatchDescriptors, TestsTheRatioFromTheFirstToTheSecondOnly) {
  // Two rows are about equally far from the one column: no matter.
  EXPECT_THAT(Match(OnALine({100, 121}), OnALine({110, 250})), ElementsAre(std::pair(0, 0)));
  EXPECT_THAT(Match(OnALine({110, 250}), OnALine({100, 121})), IsEmpty());
}

TEST(MatchDescriptors, KeepsOnlyMutualNearestNeighbours) {
  // Row 0's nearest is column 0, whose nearest is row 1.
  EXPECT_THAT(Match(OnALine({90, 101}), OnALine({100, 250})), ElementsAre(std::pair(1, 0)));
}

TEST(MatchDescriptors, GivesAColumnWithTwoEqualRowsToTheFirst) {
  EXPECT_THAT(Match(OnALine({90, 110}), OnALine({100, 250})), ElementsAre(std::pair(0, 0)));
}

TEST(MatchDescriptors, AcceptsTheOnlyCandidate) {
  EXPECT_THAT(Match(OnALine({90}), OnALine({100})), ElementsAre(std::pair(0, 0)));
}

TEST(MatchDescriptors, WidelyKeepsTheLessDistinctAndSaysSo) {
  // Ratios 0.7 (7 and 10), 0.8 (8 and 10) and 0.9 (9 and 10).
  const DescriptorMatrix rows = OnALine({20, 100, 180});
  const DescriptorMatrix columns = OnALine({27, 10, 108, 90, 189, 170});
  MatcherOptions options;
  options.max_ratio = 0.75;
  options.max_wide_ratio = 0.85;
  const auto matches = MatchDescriptorsWidely(options, rows, columns);
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].idx2, 0U);
  EXPECT_TRUE(matches[0].is_distinct);
  EXPECT_EQ(matches[1].idx2, 2U);
  EXPECT_FALSE(matches[1].is_distinct);
  EXPECT_EQ(MatchDescriptors(options, rows, columns).size(), 1U);
}

TEST(MatchDescriptors, RefusesOptionsWithProblems) {
  MatcherOptions options;
  options.max_ratio = 1.5;
  EXPECT_THROW(MatchDescriptors(options, OnALine({1}), OnALine({2})), std::logic_error);
}

TEST(MatchLargestFeatures, SeesTheFirstRowsOnly) {
  const DescriptorMatrix descriptors = RandomDescriptors(100, 1);
  const auto matches = MatchLargestFeatures({}, descriptors, descriptors, 30);
  ASSERT_EQ(matches.size(), 30U);
  EXPECT_EQ(matches.back().idx2, 29U);
  EXPECT_EQ(MatchLargestFeatures({}, descriptors, descriptors, 1000).size(), 100U);
}

TEST(MatcherOptions, NameEveryViolatedBound) {
  MatcherOptions options;
  EXPECT_THAT(options.Problems(), IsEmpty());
  options.max_ratio = 0.0;
  options.num_threads = 0;
  EXPECT_THAT(options.Problems(),
              ElementsAre(testing::HasSubstr("max_ratio"), testing::HasSubstr("num_threads")));
}

}  // namespace
}  // namespace plumb
