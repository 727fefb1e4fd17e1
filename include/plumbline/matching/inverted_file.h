// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/matching/ranked_view.h"
#include "plumbline/matching/vocabulary_tree.h"

namespace plumb {

// Which photos hold which word, with the signature of each feature. Photos are added one at a
// time; nothing is weighed before the query, so that every query counts the photos added so far.
//
// A feature of the query votes once for each photo that has a feature of the same word whose
// signature differs in at most kMaxHammingDistance bits (Jegou, Douze & Schmid, Hamming Embedding
// and Weak Geometric Consistency, ECCV 2008). Its vote weighs
//   exp(-h^2 / (2 kHammingSigma^2)) log((N + 1) / n)^2,
// h the smallest such distance in that photo, n the photos it votes for, N the photos added: the
// squared idf of a product of tf-idf vectors, but by feature instead of by word, and one vote
// however often a window repeats in a photo.
class InvertedFile {
 public:
  explicit InvertedFile(int num_words);

  // `photo` must not have been added before.
  void Add(PhotoId photo, const std::vector<VisualWord>& words);

  // At most `max_views` photos, highest score first, ties by id; only those with votes.
  std::vector<RankedView> Query(const std::vector<VisualWord>& words, int max_views) const;

  int num_photos() const { return static_cast<int>(photos_.size()); }

 private:
  struct Postings {
    std::vector<std::uint64_t> signatures;
    std::vector<std::uint32_t> photo_indices;  // Into photos_.
  };

  std::vector<PhotoId> photos_;
  std::vector<Postings> postings_;  // By word.
};

}  // namespace plumb
