// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/neighbor_search.h"

#include <gtest/gtest.h>

#include "plumbline/matching/descriptor_matcher.h"
#include "test/matching/random_descriptors.h"

namespace plumb::internal {
namespace {

DescriptorSpan Span(const DescriptorMatrix& descriptors) {
  return {descriptors.data(), static_cast<int>(descriptors.rows())};
}

std::int32_t PlainSquaredDistance(const DescriptorMatrix& set1,
                                  Eigen::Index i,
                                  const DescriptorMatrix& set2,
                                  Eigen::Index j) {
  return (set1.row(i).cast<std::int32_t>() - set2.row(j).cast<std::int32_t>()).squaredNorm();
}

Neighbors BruteForce(const DescriptorMatrix& set1, const DescriptorMatrix& set2) {
  Neighbors neighbors;
  neighbors.rows.resize(static_cast<std::size_t>(set1.rows()));
  neighbors.column_best_idx.assign(static_cast<std::size_t>(set2.rows()), kNoNeighbor);
  std::vector<std::int32_t> smallest(static_cast<std::size_t>(set2.rows()), kInfiniteDistance2);
  for (std::size_t i = 0; i < neighbors.rows.size(); ++i) {
    RowNeighbors& row = neighbors.rows[i];
    for (std::size_t j = 0; j < smallest.size(); ++j) {
      const std::int32_t distance2 = PlainSquaredDistance(
          set1, static_cast<Eigen::Index>(i), set2, static_cast<Eigen::Index>(j));
      if (distance2 < row.best_distance2) {
        row.second_distance2 = row.best_distance2;
        row.best_distance2 = distance2;
        row.best_idx = static_cast<std::int32_t>(j);
      } else if (distance2 < row.second_distance2) {
        row.second_distance2 = distance2;
      }
      if (distance2 < smallest[j]) {
        smallest[j] = distance2;
        neighbors.column_best_idx[j] = static_cast<std::int32_t>(i);
      }
    }
  }
  return neighbors;
}

void ExpectEqual(const Neighbors& expected, const Neighbors& actual) {
  EXPECT_EQ(expected.column_best_idx, actual.column_best_idx);
  ASSERT_EQ(expected.rows.size(), actual.rows.size());
  for (std::size_t i = 0; i < expected.rows.size(); ++i) {
    EXPECT_EQ(expected.rows[i].best_idx, actual.rows[i].best_idx) << "row " << i;
    EXPECT_EQ(expected.rows[i].best_distance2, actual.rows[i].best_distance2) << "row " << i;
    EXPECT_EQ(expected.rows[i].second_distance2, actual.rows[i].second_distance2) << "row " << i;
  }
}

class NeighborSearch : public testing::TestWithParam<SimdPath> {
 protected:
  void SetUp() override {
    if (!IsSupported(GetParam())) GTEST_SKIP() << "this processor lacks the instructions";
  }

  void ExpectBruteForce(const DescriptorMatrix& set1, const DescriptorMatrix& set2) {
    ExpectEqual(BruteForce(set1, set2), FindNeighbors(GetParam(), Span(set1), Span(set2), 1));
  }
};

TEST_P(NeighborSearch, AgreesWithBruteForceAtEverySizeAroundATile) {
  for (int rows : {1, 2, 5, 6, 7, 13, 251, 252, 253}) {
    for (int columns : {1, 7, 8, 24, 25, 63, 64, 65, 130}) {
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
      ExpectBruteForce(RandomDescriptors(rows, 1), RandomDescriptors(columns, 2));
    }
  }
}

TEST_P(NeighborSearch, AgreesWithBruteForceAcrossBlocksAndPanels) {
  ExpectBruteForce(RandomDescriptors(600, 3), RandomDescriptors(4500, 4));
}

TEST_P(NeighborSearch, AgreesWithBruteForceOnExtremeBytes) {
  DescriptorMatrix extremes = RandomDescriptors(40, 5);
  for (Eigen::Index i = 0; i < extremes.rows(); ++i) {
    for (Eigen::Index k = 0; k < kDescriptorSize; ++k) {
      extremes(i, k) = (extremes(i, k) + i) % 3 == 0 ? 255 : 0;
    }
  }
  extremes.row(0).setConstant(255);
  extremes.row(1).setZero();
  ExpectBruteForce(extremes, extremes);
  ExpectBruteForce(extremes.topRows(1), extremes.middleRows(1, 1));
  ExpectBruteForce(extremes.middleRows(1, 1), extremes.topRows(1));
}

TEST_P(NeighborSearch, GivesTiesToTheSmallestIndex) {
  DescriptorMatrix repeated(700, kDescriptorSize);
  const DescriptorMatrix few = RandomDescriptors(7, 6);
  for (Eigen::Index i = 0; i < repeated.rows(); ++i) repeated.row(i) = few.row(i % few.rows());
  ExpectBruteForce(repeated, repeated);
}

TEST_P(NeighborSearch, DoesNotDependOnTheNumberOfThreads) {
  const DescriptorMatrix set1 = RandomDescriptors(1500, 7);
  const DescriptorMatrix set2 = RandomDescriptors(300, 8);
  const Neighbors alone = FindNeighbors(GetParam(), Span(set1), Span(set2), 1);
  for (int num_threads : {2, 3, 16}) {
    ExpectEqual(alone, FindNeighbors(GetParam(), Span(set1), Span(set2), num_threads));
  }
}

INSTANTIATE_TEST_SUITE_P(Paths,
                         NeighborSearch,
                         testing::Values(SimdPath::kPortable,
                                         SimdPath::kAvx2,
                                         SimdPath::kAvxVnni,
                                         SimdPath::kAvx512Vnni));

TEST(SquaredDistance, AgreesWithThePlainSum) {
  const DescriptorMatrix descriptors = RandomDescriptors(50, 9);
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    EXPECT_EQ(SquaredDistance(descriptors.row(0).data(), descriptors.row(i).data()),
              PlainSquaredDistance(descriptors, 0, descriptors, i));
  }
}

TEST(SquaredDistance, HoldsTheLargestDistance) {
  const DescriptorMatrix black = DescriptorMatrix::Zero(1, kDescriptorSize);
  const DescriptorMatrix white = DescriptorMatrix::Constant(1, kDescriptorSize, 255);
  EXPECT_EQ(SquaredDistance(black.data(), white.data()), 128 * 255 * 255);
}

}  // namespace
}  // namespace plumb::internal
