// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/image/features.h"
#include "plumbline/matching/retrieval_options.h"

namespace plumb {

using WordId = std::uint32_t;

// What is left of a descriptor: its word, and on which side of the word's centre it lies. Bit k of
// the signature is set if the sum of the descriptor's elements 2k and 2k+1 exceeds the centre's.
struct VisualWord {
  WordId id = 0;
  std::uint64_t signature = 0;
};

// Hierarchical k-means on descriptors (Nister & Stewenius, Scalable Recognition with a
// Vocabulary Tree, CVPR 2006); its leaves are the words. Thread-safe: immutable.
class VocabularyTree {
 public:
  // Uses branching, depth, num_iterations and random_seed; a node with too few descriptors to
  // split stays a leaf. Deterministic. Nothing if `is_cancelled` became true.
  static std::optional<VocabularyTree> Train(const RetrievalOptions& options,
                                             const DescriptorMatrix& descriptors,
                                             const std::atomic<bool>& is_cancelled);

  // Reads what Save wrote. Throws std::runtime_error naming the file, what is wrong with it and
  // what to do.
  static VocabularyTree Load(const std::string& path);

  // Little-endian: "PLUMBVOC", uint32 version (1), uint32 descriptor size (128), uint32 number of
  // nodes; by node the uint32 index of its first child, the uint32 number of its children (0: a
  // leaf) and its centre's 128 bytes; at the end the uint64 FNV-1a hash of all bytes before.
  // Children lie behind their parent; node 0 is the root. Throws std::runtime_error naming the
  // file if it cannot be written.
  void Save(const std::string& path) const;

  int num_words() const { return num_words_; }

  // The word of one descriptor of kDescriptorSize bytes: from the root, always to the child
  // whose centre is nearest; equal distances go to the first.
  VisualWord Quantize(const std::uint8_t* descriptor) const;

  // The word of each row.
  std::vector<VisualWord> Quantize(const DescriptorMatrix& descriptors) const;

  friend bool operator==(const VocabularyTree& a, const VocabularyTree& b);

 private:
  friend class VocabularyTrainer;

  struct Node {
    std::uint32_t first_child = 0;
    std::uint32_t num_children = 0;
    WordId word = 0;  // Of a leaf.
    std::array<std::uint8_t, kDescriptorSize> center = {};
  };

  VocabularyTree() = default;
  void NumberWords();
  const Node& FindLeaf(const std::uint8_t* descriptor) const;

  std::vector<Node> nodes_;
  int num_words_ = 0;
};

}  // namespace plumb
