// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/inverted_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "matching/hamming_scan.h"
#include "matching/rank_views.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

// Of 64 bits. From a grid of both over 128 photos around a building, words trained on the first 10:
// best overlap of the first 8 photos with the best 8 by exhaustive matching (0.94).
constexpr int kMaxHammingDistance = 16;
constexpr double kHammingSigma = 6.4;

std::array<float, kMaxHammingDistance + 1> MakeWeights() {
  std::array<float, kMaxHammingDistance + 1> weights = {};
  for (int h = 0; h <= kMaxHammingDistance; ++h) {
    weights[static_cast<std::size_t>(h)] =
        static_cast<float>(std::exp(-h * h / (2.0 * kHammingSigma * kHammingSigma)));
  }
  return weights;
}

// The photos one feature votes for, each with its best weight.
class Ballot {
 public:
  explicit Ballot(std::size_t num_photos) : best_(num_photos, 0.0F) {}

  void Vote(std::uint32_t photo_idx, float weight) {
    if (best_[photo_idx] == 0.0F) voted_.push_back(photo_idx);
    best_[photo_idx] = std::max(best_[photo_idx], weight);
  }

  // Adds the votes to the scores and forgets them.
  void CountInto(std::vector<double>* scores) {
    if (voted_.empty()) return;
    const double idf =
        std::log(static_cast<double>(best_.size() + 1) / static_cast<double>(voted_.size()));
    for (std::uint32_t photo_idx : voted_) {
      (*scores)[photo_idx] += idf * idf * best_[photo_idx];
      best_[photo_idx] = 0.0F;
    }
    voted_.clear();
  }

 private:
  std::vector<float> best_;
  std::vector<std::uint32_t> voted_;
};

}  // namespace

InvertedFile::InvertedFile(int num_words) : postings_(static_cast<std::size_t>(num_words)) {}

void InvertedFile::Add(PhotoId photo, const std::vector<VisualWord>& words) {
  PLUMB_CHECK(std::find(photos_.begin(), photos_.end(), photo) == photos_.end());
  const auto photo_idx = static_cast<std::uint32_t>(photos_.size());
  photos_.push_back(photo);
  for (const VisualWord& word : words) {
    Postings& postings = postings_.at(word.id);
    postings.signatures.push_back(word.signature);
    postings.photo_indices.push_back(photo_idx);
  }
}

std::vector<RankedView> InvertedFile::Query(const std::vector<VisualWord>& words,
                                            int max_views) const {
  static const auto kWeights = MakeWeights();
  std::vector<double> scores(photos_.size(), 0.0);
  Ballot ballot(photos_.size());
  std::vector<internal::SignatureHit> hits;
  for (const VisualWord& word : words) {
    const Postings& postings = postings_.at(word.id);
    internal::FindSimilarSignatures(
        postings.signatures, word.signature, kMaxHammingDistance, &hits);
    for (const internal::SignatureHit& hit : hits) {
      ballot.Vote(postings.photo_indices[hit.idx], kWeights[hit.distance]);
    }
    ballot.CountInto(&scores);
  }
  std::vector<RankedView> views;
  for (std::size_t i = 0; i < photos_.size(); ++i) views.push_back({photos_[i], scores[i]});
  return internal::RankViews(std::move(views), max_views);
}

}  // namespace plumb
