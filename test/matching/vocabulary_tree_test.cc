// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/vocabulary_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "test/matching/random_descriptors.h"

namespace plumb {
namespace {

VocabularyTree Train(const DescriptorMatrix& descriptors, RetrievalOptions options = {}) {
  const std::atomic<bool> is_cancelled{false};
  return VocabularyTree::Train(options, descriptors, is_cancelled).value();
}

TEST(VocabularyTree, SeparatesWellSeparatedClusters) {
  const DescriptorMatrix centers = RandomDescriptors(8, 1);
  const DescriptorMatrix many = centers.replicate(40, 1);
  RetrievalOptions options;
  options.branching = 8;
  options.depth = 3;
  const VocabularyTree tree = Train(Perturbed(many, 2, 2), options);
  for (Eigen::Index i = 0; i < centers.rows(); ++i) {
    const WordId word = tree.Quantize(centers.row(i).data()).id;
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_NE(word, tree.Quantize(centers.row(j).data()).id);
  }
}

TEST(VocabularyTree, UsesAllItsWordsOnItsOwnTrainingData) {
  RetrievalOptions options;
  options.branching = 6;
  options.depth = 2;
  const DescriptorMatrix descriptors = RandomDescriptors(3000, 1);
  const VocabularyTree tree = Train(descriptors, options);
  EXPECT_GT(tree.num_words(), 6);
  EXPECT_LE(tree.num_words(), 36);
  std::set<WordId> used;
  for (const VisualWord& word : tree.Quantize(descriptors)) used.insert(word.id);
  EXPECT_EQ(static_cast<int>(used.size()), tree.num_words());
  EXPECT_LT(static_cast<int>(*used.rbegin()), tree.num_words());
}

TEST(VocabularyTree, OfOneLevelPutsEachDescriptorToTheNearestMean) {
  RetrievalOptions options;
  options.branching = 10;
  options.depth = 1;
  options.num_iterations = 1000;  // Until nothing moves.
  const DescriptorMatrix descriptors = RandomDescriptors(1000, 1);
  const std::vector<VisualWord> words = Train(descriptors, options).Quantize(descriptors);
  Eigen::MatrixXi sums = Eigen::MatrixXi::Zero(10, kDescriptorSize);
  Eigen::VectorXi counts = Eigen::VectorXi::Zero(10);
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    sums.row(words[static_cast<std::size_t>(i)].id) += descriptors.row(i).cast<int>();
    ++counts(words[static_cast<std::size_t>(i)].id);
  }
  DescriptorMatrix means(10, kDescriptorSize);
  for (Eigen::Index w = 0; w < 10; ++w) {
    ASSERT_GT(counts(w), 0);
    means.row(w) = ((sums.row(w).array() + counts(w) / 2) / counts(w)).cast<std::uint8_t>();
  }
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    const std::uint8_t* descriptor = descriptors.row(i).data();
    const Eigen::Index own = words[static_cast<std::size_t>(i)].id;
    for (Eigen::Index w = 0; w < 10; ++w) {
      EXPECT_LE(SquaredDistance(descriptor, means.row(own).data()),
                SquaredDistance(descriptor, means.row(w).data()));
    }
  }
}

TEST(VocabularyTree, KeepsTheSignatureUnderSmallNoise) {
  const DescriptorMatrix descriptors = RandomDescriptors(500, 1);
  const VocabularyTree tree = Train(descriptors, [] {
    RetrievalOptions options;
    options.depth = 1;
    return options;
  }());
  const auto words = tree.Quantize(descriptors);
  const auto again = tree.Quantize(Perturbed(descriptors, 2, 2));
  double same_sum = 0.0;
  double other_sum = 0.0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t other = (i + 1) % words.size();
    same_sum += __builtin_popcountll(words[i].signature ^ again[i].signature);
    other_sum += __builtin_popcountll(words[i].signature ^ words[other].signature);
  }
  EXPECT_LT(same_sum / 500.0, 8.0);    // Bits of 64.
  EXPECT_GT(other_sum / 500.0, 24.0);  // Unrelated signatures differ in about half.
}

TEST(VocabularyTree, IsTheSameForTheSameSeedOnly) {
  const DescriptorMatrix descriptors = RandomDescriptors(2000, 1);
  RetrievalOptions other_seed;
  other_seed.random_seed = 7;
  EXPECT_TRUE(Train(descriptors) == Train(descriptors));
  EXPECT_FALSE(Train(descriptors) == Train(descriptors, other_seed));
}

TEST(VocabularyTree, OfTooFewDescriptorsHasOneWord) {
  EXPECT_EQ(Train(RandomDescriptors(3, 1)).num_words(), 1);
  EXPECT_EQ(Train(DescriptorMatrix(0, kDescriptorSize)).num_words(), 1);
  const DescriptorMatrix equal = RandomDescriptors(1, 1).replicate(1000, 1);
  EXPECT_EQ(Train(equal).num_words(), 1);
}

TEST(VocabularyTree, OfACancelledTrainingIsNothing) {
  const std::atomic<bool> is_cancelled{true};
  EXPECT_FALSE(VocabularyTree::Train({}, RandomDescriptors(100, 1), is_cancelled).has_value());
}

class VocabularyFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  // What Load says of the file after `damage`.
  std::string ErrorAfter(const std::function<void(std::vector<std::uint8_t>*)>& damage) {
    tree_.Save(path_);
    std::vector<std::uint8_t> bytes = ReadFileBytes(path_);
    damage(&bytes);
    WriteFileAtomically(path_, bytes.data(), bytes.size());
    try {
      VocabularyTree::Load(path_);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path_));
      EXPECT_THAT(error.what(), testing::HasSubstr("save the vocabulary again"));
      return error.what();
    }
    return "";
  }

  const VocabularyTree tree_ = Train(RandomDescriptors(2000, 1));
  const std::string path_ = testing::TempDir() + "vocabulary_tree_test.voc";
};

TEST_F(VocabularyFile, ComesBackAsItWas) {
  tree_.Save(path_);
  const VocabularyTree loaded = VocabularyTree::Load(path_);
  EXPECT_TRUE(loaded == tree_);
  EXPECT_EQ(loaded.num_words(), tree_.num_words());
  const DescriptorMatrix queries = RandomDescriptors(100, 3);
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    const VisualWord before = tree_.Quantize(queries.row(i).data());
    const VisualWord after = loaded.Quantize(queries.row(i).data());
    EXPECT_EQ(before.id, after.id);
    EXPECT_EQ(before.signature, after.signature);
  }
}

TEST_F(VocabularyFile, OfAnotherKindIsRefused) {
  EXPECT_THAT(ErrorAfter([](auto* bytes) { bytes->front() = 'X'; }),
              testing::HasSubstr("not a Plumbline vocabulary"));
  EXPECT_THAT(ErrorAfter([](auto* bytes) { bytes->clear(); }),
              testing::HasSubstr("not a Plumbline vocabulary"));
}

TEST_F(VocabularyFile, OfAnotherVersionIsRefused) {
  EXPECT_THAT(ErrorAfter([](auto* bytes) { (*bytes)[8] = 99; }),
              testing::HasSubstr("has version 99"));
}

TEST_F(VocabularyFile, OfAnotherDescriptorIsRefused) {
  EXPECT_THAT(ErrorAfter([](auto* bytes) { (*bytes)[12] = 64; }),
              testing::HasSubstr("descriptors of 64 bytes"));
}

TEST_F(VocabularyFile, ThatIsTruncatedIsRefused) {
  EXPECT_THAT(ErrorAfter([](auto* bytes) { bytes->resize(10); }),
              testing::HasSubstr("ends within its header"));
  EXPECT_THAT(ErrorAfter([](auto* bytes) { bytes->resize(bytes->size() - 1); }),
              testing::HasSubstr("bytes, not the"));
}

TEST_F(VocabularyFile, ThatIsDamagedIsRefused) {
  EXPECT_THAT(ErrorAfter([](auto* bytes) { (*bytes)[bytes->size() / 2] ^= 1; }),
              testing::HasSubstr("damaged"));
}

TEST_F(VocabularyFile, WhoseNodesAreNoTreeIsRefused) {
  const auto make_the_root_its_own_child = [](std::vector<std::uint8_t>* bytes) {
    (*bytes)[20] = 0;  // The root's first child.
    std::uint64_t hash = 14695981039346656037U;
    for (std::size_t i = 0; i + 8 < bytes->size(); ++i) {
      hash = (hash ^ (*bytes)[i]) * 1099511628211U;
    }
    for (std::size_t i = 0; i < 8; ++i) {
      (*bytes)[bytes->size() - 8 + i] = static_cast<std::uint8_t>(hash >> (8 * i));
    }
  };
  EXPECT_THAT(ErrorAfter(make_the_root_its_own_child), testing::HasSubstr("not a tree"));
}

}  // namespace
}  // namespace plumb
