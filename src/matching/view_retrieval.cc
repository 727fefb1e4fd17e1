// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/view_retrieval.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <unordered_set>

#include "matching/background_training.h"
#include "matching/rank_views.h"
#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "plumbline/matching/inverted_file.h"
#include "plumbline/matching/vocabulary_tree.h"

namespace plumb {

class ViewRetrieval::Impl {
 public:
  explicit Impl(const RetrievalOptions& options) : options_(options) {
    ThrowIfProblems("retrieval", options.Problems());
    if (!options.vocabulary_path.empty()) TakeTree(VocabularyTree::Load(options.vocabulary_path));
  }

  void Add(PhotoId photo, const DescriptorMatrix& descriptors) {
    PLUMB_CHECK(added_.insert(photo).second);
    if (tree_) {
      inverted_file_->Add(photo, tree_->Quantize(descriptors));
      return;
    }
    waiting_.push_back({photo, descriptors});
    const auto num_waiting = static_cast<int>(waiting_.size());
    if (num_waiting == options_.num_training_photos) {
      training_.emplace(options_, SampleDescriptors());
    }
    if (training_ && IsTreeDue(num_waiting - options_.num_training_photos)) {
      TakeTree(training_->Take());
    }
  }

  std::vector<RankedView> Query(const DescriptorMatrix& descriptors, int max_views) const {
    if (tree_) return inverted_file_->Query(tree_->Quantize(descriptors), max_views);
    std::vector<RankedView> views;
    for (const WaitingPhoto& waiting : waiting_) {
      const std::size_t num_matches =
          MatchLargestFeatures(
              MatcherOptions(), descriptors, waiting.descriptors, options_.num_compared_features)
              .size();
      views.push_back({waiting.photo, static_cast<double>(num_matches)});
    }
    return internal::RankViews(std::move(views), max_views);
  }

  const std::optional<VocabularyTree>& tree() const { return tree_; }

 private:
  // A photo added before there was a tree.
  struct WaitingPhoto {
    PhotoId photo;
    DescriptorMatrix descriptors;
  };

  // Waits no longer than twice the photos of the training: each of them holds its descriptors.
  bool IsTreeDue(int num_photos_since) const {
    if (options_.deterministic) return num_photos_since >= options_.num_photos_until_trained;
    return training_->IsReady() || num_photos_since >= options_.num_training_photos;
  }

  // An equal share of each photo's descriptors, spread evenly over their scales.
  DescriptorMatrix SampleDescriptors() const {
    const Eigen::Index max_share = std::max<Eigen::Index>(
        options_.max_training_descriptors / static_cast<Eigen::Index>(waiting_.size()), 1);
    Eigen::Index num_sampled = 0;
    for (const WaitingPhoto& waiting : waiting_) {
      num_sampled += std::min(max_share, waiting.descriptors.rows());
    }
    DescriptorMatrix sample(num_sampled, kDescriptorSize);
    Eigen::Index next = 0;
    for (const WaitingPhoto& waiting : waiting_) {
      const Eigen::Index num_rows = waiting.descriptors.rows();
      const Eigen::Index share = std::min(max_share, num_rows);
      for (Eigen::Index i = 0; i < share; ++i) {
        sample.row(next++) = waiting.descriptors.row(i * num_rows / share);
      }
    }
    return sample;
  }

  void TakeTree(VocabularyTree tree) {
    training_.reset();
    tree_ = std::move(tree);
    inverted_file_.emplace(tree_->num_words());
    for (const WaitingPhoto& waiting : waiting_) {
      inverted_file_->Add(waiting.photo, tree_->Quantize(waiting.descriptors));
    }
    waiting_.clear();
    waiting_.shrink_to_fit();
  }

  RetrievalOptions options_;
  std::unordered_set<PhotoId> added_;
  std::vector<WaitingPhoto> waiting_;
  std::optional<internal::BackgroundTraining> training_;
  std::optional<VocabularyTree> tree_;
  std::optional<InvertedFile> inverted_file_;  // Together with the tree.
};

ViewRetrieval::ViewRetrieval(const RetrievalOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

ViewRetrieval::~ViewRetrieval() = default;

void ViewRetrieval::Add(PhotoId photo, const DescriptorMatrix& descriptors) {
  impl_->Add(photo, descriptors);
}

std::vector<RankedView> ViewRetrieval::Query(const DescriptorMatrix& descriptors,
                                             int max_views) const {
  PLUMB_CHECK_GE(max_views, 0);
  return impl_->Query(descriptors, max_views);
}

bool ViewRetrieval::HasVocabulary() const { return impl_->tree().has_value(); }

void ViewRetrieval::SaveVocabulary(const std::string& path) const {
  if (!HasVocabulary()) throw std::logic_error("there is no vocabulary to save yet");
  impl_->tree()->Save(path);
}

}  // namespace plumb
