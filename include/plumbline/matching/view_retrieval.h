// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/image/features.h"
#include "plumbline/matching/ranked_view.h"
#include "plumbline/matching/retrieval_options.h"

namespace plumb {

// Answers which photos look like a given one. Photos are added one at a time. With a
// trained vocabulary tree it asks an inverted file; without one it compares the
// largest features with those of every photo, while the tree trains itself on the session's
// own descriptors in a background thread; Add takes the finished tree in. Not thread-safe.
class ViewRetrieval {
 public:
  // Loads options.vocabulary_path unless empty. Throws std::runtime_error naming the file
  // if it cannot be read, std::invalid_argument if options.Problems() is not empty.
  explicit ViewRetrieval(const RetrievalOptions& options);
  ~ViewRetrieval();

  // Copies what it needs. `photo` must not have been added before.
  void Add(PhotoId photo, const DescriptorMatrix& descriptors);

  // At most `max_views` of the added photos, best first; ties by id. Photos with no
  // likeness at all are left out.
  std::vector<RankedView> Query(const DescriptorMatrix& descriptors, int max_views) const;

  bool HasVocabulary() const;

  // Saves the tree in use. Throws std::runtime_error naming the file, std::logic_error if
  // there is no tree.
  void SaveVocabulary(const std::string& path) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
