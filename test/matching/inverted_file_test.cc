// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/inverted_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "test/matching/synthetic_photos.h"

namespace plumb {
namespace {

PhotoId IdOf(std::uint32_t value) { return {value}; }

std::vector<std::uint32_t> Ids(const std::vector<RankedView>& views) {
  std::vector<std::uint32_t> ids;
  for (const RankedView& view : views) ids.push_back(view.photo.value);
  return ids;
}

// A signature with the lowest `num_bits` set.
std::uint64_t Bits(int num_bits) { return (std::uint64_t{1} << num_bits) - 1; }

TEST(InvertedFile, RanksTheCopyOfAPhotoFirst) {
  const std::vector<DescriptorMatrix> photos = PhotosAlongAWall(12, 1);
  DescriptorMatrix all(0, kDescriptorSize);
  for (const DescriptorMatrix& photo : photos) {
    DescriptorMatrix joined(all.rows() + photo.rows(), kDescriptorSize);
    joined << all, photo;
    all = joined;
  }
  const std::atomic<bool> is_cancelled{false};
  RetrievalOptions options;
  options.depth = 2;
  const VocabularyTree tree = VocabularyTree::Train(options, all, is_cancelled).value();
  InvertedFile file(tree.num_words());
  for (std::uint32_t i = 0; i < photos.size(); ++i) file.Add(IdOf(i), tree.Quantize(photos[i]));
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    EXPECT_EQ(Ids(file.Query(tree.Quantize(photos[i]), 1)), std::vector<std::uint32_t>{i});
  }
}

TEST(InvertedFile, ScoresByTheDocumentedFormula) {
  InvertedFile file(4);
  file.Add(IdOf(5), {{1, 0}, {2, 0}});
  file.Add(IdOf(6), {{1, Bits(4)}});
  file.Add(IdOf(7), {{3, 0}});
  const auto views = file.Query({{1, 0}, {2, 0}}, 10);
  ASSERT_EQ(Ids(views), (std::vector<std::uint32_t>{5, 6}));
  const double idf_of_two = std::pow(std::log(4.0 / 2.0), 2.0);
  const double idf_of_one = std::pow(std::log(4.0 / 1.0), 2.0);
  constexpr double kSigma = 6.4;
  EXPECT_NEAR(views[0].score, idf_of_two + idf_of_one, 1e-6);
  EXPECT_NEAR(views[1].score, idf_of_two * std::exp(-16.0 / (2.0 * kSigma * kSigma)), 1e-6);
}

TEST(InvertedFile, LetsAFeatureVoteOnceForAPhotoWithRepeatedWindows) {
  InvertedFile file(2);
  file.Add(IdOf(0), {{1, Bits(2)}});
  file.Add(IdOf(1), {{1, Bits(3)}, {1, Bits(3)}, {1, Bits(3)}});
  EXPECT_EQ(Ids(file.Query({{1, Bits(2)}}, 10)), (std::vector<std::uint32_t>{0, 1}));
}

TEST(InvertedFile, IgnoresFeaturesOfTheSameWordWithAnotherSignature) {
  InvertedFile file(2);
  file.Add(IdOf(0), {{1, Bits(16)}});
  file.Add(IdOf(1), {{1, Bits(17)}});
  EXPECT_EQ(Ids(file.Query({{1, 0}}, 10)), std::vector<std::uint32_t>{0});
}

TEST(InvertedFile, BreaksTiesByIdAndCutsTheList) {
  InvertedFile file(2);
  for (std::uint32_t id : {9U, 3U, 6U}) file.Add(IdOf(id), {{1, 0}});
  EXPECT_EQ(Ids(file.Query({{1, 0}}, 2)), (std::vector<std::uint32_t>{3, 6}));
  EXPECT_THAT(file.Query({{1, 0}}, 0), testing::IsEmpty());
}

TEST(InvertedFile, WeighsByThePhotosAddedSoFar) {
  InvertedFile file(3);
  file.Add(IdOf(0), {{1, 0}});
  const double alone = file.Query({{1, 0}}, 1).at(0).score;
  file.Add(IdOf(1), {{2, 0}});
  EXPECT_GT(file.Query({{1, 0}}, 1).at(0).score, alone);
}

TEST(InvertedFile, RefusesThePhotoItHas) {
  InvertedFile file(1);
  file.Add(IdOf(0), {});
  EXPECT_THROW(file.Add(IdOf(0), {}), std::logic_error);
}

}  // namespace
}  // namespace plumb
