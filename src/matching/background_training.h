// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "plumbline/matching/vocabulary_tree.h"

namespace plumb::internal {

// Trains a vocabulary tree in a thread of its own; the destructor cancels it.
class BackgroundTraining {
 public:
  BackgroundTraining(const RetrievalOptions& options, DescriptorMatrix descriptors)
      : thread_([this, options, descriptors = std::move(descriptors)] {
          tree_ = VocabularyTree::Train(options, descriptors, is_cancelled_);
          is_ready_ = true;
        }) {}

  ~BackgroundTraining() {
    is_cancelled_ = true;
    if (thread_.joinable()) thread_.join();
  }

  BackgroundTraining(const BackgroundTraining&) = delete;
  BackgroundTraining& operator=(const BackgroundTraining&) = delete;

  bool IsReady() const { return is_ready_; }

  // Waits for the end of the training. To be called once.
  VocabularyTree Take() {
    thread_.join();
    return std::move(tree_.value());
  }

 private:
  std::atomic<bool> is_cancelled_{false};
  std::atomic<bool> is_ready_{false};
  std::optional<VocabularyTree> tree_;
  std::thread thread_;  // Last: it uses the members above.
};

}  // namespace plumb::internal
