// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <vector>

#include "plumbline/matching/vocabulary_tree.h"

namespace plumb {

// Grows a vocabulary tree breadth first.
class VocabularyTrainer {
 public:
  VocabularyTrainer(const RetrievalOptions& options,
                    const DescriptorMatrix& descriptors,
                    const std::atomic<bool>& is_cancelled);

  std::optional<VocabularyTree> Run();

 private:
  using Center = std::array<std::uint8_t, kDescriptorSize>;

  struct Cluster {
    std::uint32_t node = 0;
    int level = 0;
    std::vector<Eigen::Index> members;
  };

  // Appends the cluster's children to the tree and returns their clusters.
  std::vector<Cluster> Split(const Cluster& cluster);
  std::vector<Center> DrawCenters(const std::vector<Eigen::Index>& members);
  // The nearest centre of each member.
  std::vector<std::size_t> Assign(const std::vector<Eigen::Index>& members,
                                  const std::vector<Center>& centers) const;
  // Moves each centre to the mean of its members; an empty one stays.
  void MoveCenters(const std::vector<Eigen::Index>& members,
                   const std::vector<std::size_t>& assignment,
                   std::vector<Center>* centers) const;

  const RetrievalOptions& options_;
  const DescriptorMatrix& descriptors_;
  const std::atomic<bool>& is_cancelled_;
  std::mt19937 generator_;
  VocabularyTree tree_;
};

}  // namespace plumb
