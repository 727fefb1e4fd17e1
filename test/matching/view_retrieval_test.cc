// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/view_retrieval.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "test/matching/synthetic_photos.h"

namespace plumb {
namespace {

constexpr int kNumPhotos = 20;
constexpr std::uint32_t kFirstId = 100;

RetrievalOptions DeterministicOptions() {
  RetrievalOptions options;
  options.deterministic = true;
  options.depth = 2;  // Few descriptors, few words.
  return options;
}

PhotoId IdOf(int photo) { return {kFirstId + static_cast<std::uint32_t>(photo)}; }

void AddPhotos(const std::vector<DescriptorMatrix>& photos,
               int begin,
               int end,
               ViewRetrieval* retrieval) {
  for (int i = begin; i < end; ++i) {
    retrieval->Add(IdOf(i), photos[static_cast<std::size_t>(i)]);
  }
}

std::vector<int> Photos(const std::vector<RankedView>& views) {
  std::vector<int> photos;
  for (const RankedView& view : views)
    photos.push_back(static_cast<int>(view.photo.value - kFirstId));
  return photos;
}

TEST(ViewRetrieval, FindsTheNeighboursBeforeThereIsATree) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  ViewRetrieval retrieval(DeterministicOptions());
  AddPhotos(photos, 0, 8, &retrieval);
  ASSERT_FALSE(retrieval.HasVocabulary());
  EXPECT_THAT(Photos(retrieval.Query(photos[8], 3)), testing::ElementsAre(7, 6, 5));
  EXPECT_THAT(Photos(retrieval.Query(photos[4], 1)), testing::ElementsAre(4));
}

TEST(ViewRetrieval, FindsTheNeighboursOnceTheTreeIsTrained) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  ViewRetrieval retrieval(DeterministicOptions());
  AddPhotos(photos, 0, 19, &retrieval);
  ASSERT_TRUE(retrieval.HasVocabulary());
  EXPECT_THAT(Photos(retrieval.Query(photos[19], 3)), testing::ElementsAre(18, 17, 16));
  // Photo 3 was added before the training, photo 15 after it.
  EXPECT_THAT(Photos(retrieval.Query(photos[3], 3)),
              testing::ElementsAre(3, testing::AnyOf(2, 4), testing::AnyOf(2, 4)));
  EXPECT_THAT(Photos(retrieval.Query(photos[15], 3)),
              testing::ElementsAre(15, testing::AnyOf(14, 16), testing::AnyOf(14, 16)));
}

TEST(ViewRetrieval, TakesTheTreeInAtAFixedPhotoIfDeterministic) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  const RetrievalOptions options = DeterministicOptions();
  ViewRetrieval retrieval(options);
  const int last_without = options.num_training_photos + options.num_photos_until_trained - 1;
  AddPhotos(photos, 0, last_without, &retrieval);
  EXPECT_FALSE(retrieval.HasVocabulary());
  AddPhotos(photos, last_without, last_without + 1, &retrieval);
  EXPECT_TRUE(retrieval.HasVocabulary());
}

TEST(ViewRetrieval, HasATreeByTwiceTheTrainingPhotosIfNotDeterministic) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  RetrievalOptions options = DeterministicOptions();
  options.deterministic = false;
  ViewRetrieval retrieval(options);
  AddPhotos(photos, 0, 2 * options.num_training_photos, &retrieval);
  EXPECT_TRUE(retrieval.HasVocabulary());
  EXPECT_THAT(Photos(retrieval.Query(photos[19], 2)), testing::ElementsAre(19, 18));
}

TEST(ViewRetrieval, GivesTheSameRanksAndScoresAgain) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  ViewRetrieval first(DeterministicOptions());
  ViewRetrieval second(DeterministicOptions());
  for (int i = 0; i < kNumPhotos; ++i) {
    const DescriptorMatrix& photo = photos[static_cast<std::size_t>(i)];
    const auto views1 = first.Query(photo, 10);
    const auto views2 = second.Query(photo, 10);
    ASSERT_EQ(Photos(views1), Photos(views2));
    for (std::size_t v = 0; v < views1.size(); ++v) EXPECT_EQ(views1[v].score, views2[v].score);
    first.Add(IdOf(i), photo);
    second.Add(IdOf(i), photo);
  }
}

TEST(ViewRetrieval, LeavesOutPhotosWithNoLikeness) {
  ViewRetrieval retrieval(DeterministicOptions());
  retrieval.Add(IdOf(0), RandomDescriptors(300, 1));
  retrieval.Add(IdOf(1), DescriptorMatrix(0, kDescriptorSize));
  EXPECT_THAT(Photos(retrieval.Query(RandomDescriptors(300, 1), 5)), testing::ElementsAre(0));
  EXPECT_THAT(retrieval.Query(DescriptorMatrix(0, kDescriptorSize), 5), testing::IsEmpty());
}

TEST(ViewRetrieval, OfNoPhotosFindsNone) {
  const ViewRetrieval retrieval(DeterministicOptions());
  EXPECT_THAT(retrieval.Query(RandomDescriptors(10, 1), 5), testing::IsEmpty());
}

TEST(ViewRetrieval, EndsAtOnceWhileTheTreeIsTrained) {
  RetrievalOptions options;
  options.num_training_photos = 1;
  options.num_photos_until_trained = 1000;
  options.num_iterations = 1000000;
  options.max_training_descriptors = 20000;
  ViewRetrieval retrieval(options);
  retrieval.Add(IdOf(0), RandomDescriptors(20000, 1));
}

TEST(ViewRetrieval, RefusesThePhotoItHas) {
  ViewRetrieval retrieval(DeterministicOptions());
  retrieval.Add(IdOf(0), RandomDescriptors(10, 1));
  EXPECT_THROW(retrieval.Add(IdOf(0), RandomDescriptors(10, 1)), std::logic_error);
}

TEST(ViewRetrieval, UsesASavedTreeFromTheFirstPhoto) {
  const auto photos = PhotosAlongAWall(kNumPhotos, 1);
  const std::string path = testing::TempDir() + "view_retrieval_test.voc";
  ViewRetrieval trained(DeterministicOptions());
  EXPECT_THROW(trained.SaveVocabulary(path), std::logic_error);
  AddPhotos(photos, 0, kNumPhotos, &trained);
  trained.SaveVocabulary(path);

  RetrievalOptions options;
  options.vocabulary_path = path;
  ViewRetrieval loaded(options);
  EXPECT_TRUE(loaded.HasVocabulary());
  AddPhotos(photos, 0, kNumPhotos, &loaded);
  EXPECT_EQ(Photos(loaded.Query(photos[7], 8)), Photos(trained.Query(photos[7], 8)));
  std::filesystem::remove(path);
}

TEST(ViewRetrieval, NamesAVocabularyFileThatIsNotThere) {
  RetrievalOptions options;
  options.vocabulary_path = "/nowhere/some.voc";
  try {
    const ViewRetrieval retrieval(options);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/nowhere/some.voc"));
  }
}

TEST(ViewRetrieval, RefusesOptionsWithProblems) {
  RetrievalOptions options;
  options.branching = 1;
  options.num_training_photos = 0;
  EXPECT_EQ(options.Problems().size(), 2U);
  EXPECT_THROW(ViewRetrieval{options}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb
