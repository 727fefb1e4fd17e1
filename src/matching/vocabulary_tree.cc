// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/vocabulary_tree.h"

#include <algorithm>

#include "matching/vocabulary_trainer.h"
#include "plumbline/matching/descriptor_matcher.h"

namespace plumb {

std::optional<VocabularyTree> VocabularyTree::Train(const RetrievalOptions& options,
                                                    const DescriptorMatrix& descriptors,
                                                    const std::atomic<bool>& is_cancelled) {
  return VocabularyTrainer(options, descriptors, is_cancelled).Run();
}

VisualWord VocabularyTree::Quantize(const std::uint8_t* descriptor) const {
  const Node& leaf = FindLeaf(descriptor);
  VisualWord word;
  word.id = leaf.word;
  for (std::size_t k = 0; k < kDescriptorSize / 2; ++k) {
    const bool is_above =
        descriptor[2 * k] + descriptor[2 * k + 1] > leaf.center[2 * k] + leaf.center[2 * k + 1];
    word.signature |= static_cast<std::uint64_t>(is_above) << k;
  }
  return word;
}

std::vector<VisualWord> VocabularyTree::Quantize(const DescriptorMatrix& descriptors) const {
  std::vector<VisualWord> words;
  words.reserve(static_cast<std::size_t>(descriptors.rows()));
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    words.push_back(Quantize(descriptors.row(i).data()));
  }
  return words;
}

const VocabularyTree::Node& VocabularyTree::FindLeaf(const std::uint8_t* descriptor) const {
  const Node* node = nodes_.data();
  while (node->num_children > 0) {
    const Node* child = nodes_.data() + node->first_child;
    const Node* const end = child + node->num_children;
    const Node* nearest = child;
    std::int32_t smallest = SquaredDistance(descriptor, child->center.data());
    for (++child; child != end; ++child) {
      const std::int32_t distance2 = SquaredDistance(descriptor, child->center.data());
      if (distance2 >= smallest) continue;
      smallest = distance2;
      nearest = child;
    }
    node = nearest;
  }
  return *node;
}

void VocabularyTree::NumberWords() {
  num_words_ = 0;
  for (Node& node : nodes_) {
    if (node.num_children == 0) node.word = static_cast<WordId>(num_words_++);
  }
}

bool operator==(const VocabularyTree& a, const VocabularyTree& b) {
  return std::equal(a.nodes_.begin(),
                    a.nodes_.end(),
                    b.nodes_.begin(),
                    b.nodes_.end(),
                    [](const VocabularyTree::Node& x, const VocabularyTree::Node& y) {
                      return x.first_child == y.first_child && x.num_children == y.num_children &&
                             x.center == y.center;
                    });
}

}  // namespace plumb
