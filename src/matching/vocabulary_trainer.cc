// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/vocabulary_trainer.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "plumbline/common/check.h"
#include "plumbline/matching/descriptor_matcher.h"

namespace plumb {

VocabularyTrainer::VocabularyTrainer(const RetrievalOptions& options,
                                     const DescriptorMatrix& descriptors,
                                     const std::atomic<bool>& is_cancelled)
    : options_(options),
      descriptors_(descriptors),
      is_cancelled_(is_cancelled),
      generator_(static_cast<std::uint32_t>(options.random_seed)) {
  PLUMB_CHECK(options.Problems().empty());
}

std::optional<VocabularyTree> VocabularyTrainer::Run() {
  tree_.nodes_.resize(1);
  Cluster root;
  for (Eigen::Index i = 0; i < descriptors_.rows(); ++i) root.members.push_back(i);
  std::deque<Cluster> clusters = {std::move(root)};
  while (!clusters.empty()) {
    for (Cluster& child : Split(clusters.front())) clusters.push_back(std::move(child));
    clusters.pop_front();
    if (is_cancelled_) return std::nullopt;
  }
  tree_.NumberWords();
  return std::move(tree_);
}

std::vector<VocabularyTrainer::Cluster> VocabularyTrainer::Split(const Cluster& cluster) {
  const auto branching = static_cast<std::size_t>(options_.branching);
  if (cluster.level >= options_.depth || cluster.members.size() < 2 * branching) return {};
  std::vector<Center> centers = DrawCenters(cluster.members);
  if (centers.size() < 2) return {};
  std::vector<std::size_t> assignment = Assign(cluster.members, centers);
  for (int iteration = 0; iteration < options_.num_iterations; ++iteration) {
    if (is_cancelled_) return {};
    MoveCenters(cluster.members, assignment, &centers);
    std::vector<std::size_t> next = Assign(cluster.members, centers);
    if (next == assignment) break;
    assignment = std::move(next);
  }

  const auto first_child = static_cast<std::uint32_t>(tree_.nodes_.size());
  tree_.nodes_[cluster.node].first_child = first_child;
  tree_.nodes_[cluster.node].num_children = static_cast<std::uint32_t>(centers.size());
  std::vector<Cluster> children(centers.size());
  for (std::size_t c = 0; c < centers.size(); ++c) {
    children[c].node = first_child + static_cast<std::uint32_t>(c);
    children[c].level = cluster.level + 1;
    tree_.nodes_.emplace_back().center = centers[c];
  }
  for (std::size_t i = 0; i < assignment.size(); ++i) {
    children[assignment[i]].members.push_back(cluster.members[i]);
  }
  return children;
}

// Distinct members, drawn at random.
std::vector<VocabularyTrainer::Center> VocabularyTrainer::DrawCenters(
    const std::vector<Eigen::Index>& members) {
  std::vector<Eigen::Index> drawn;
  std::sample(
      members.begin(), members.end(), std::back_inserter(drawn), options_.branching, generator_);
  std::vector<Center> centers;
  for (Eigen::Index member : drawn) {
    Center center;
    std::copy_n(descriptors_.row(member).data(), kDescriptorSize, center.begin());
    if (std::find(centers.begin(), centers.end(), center) == centers.end()) {
      centers.push_back(center);
    }
  }
  return centers;
}

std::vector<std::size_t> VocabularyTrainer::Assign(const std::vector<Eigen::Index>& members,
                                                   const std::vector<Center>& centers) const {
  std::vector<std::size_t> assignment(members.size(), 0);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::uint8_t* descriptor = descriptors_.row(members[i]).data();
    std::int32_t smallest = SquaredDistance(descriptor, centers[0].data());
    for (std::size_t c = 1; c < centers.size(); ++c) {
      const std::int32_t distance2 = SquaredDistance(descriptor, centers[c].data());
      if (distance2 >= smallest) continue;
      smallest = distance2;
      assignment[i] = c;
    }
  }
  return assignment;
}

void VocabularyTrainer::MoveCenters(const std::vector<Eigen::Index>& members,
                                    const std::vector<std::size_t>& assignment,
                                    std::vector<Center>* centers) const {
  std::vector<std::array<std::uint64_t, kDescriptorSize>> sums(centers->size());
  std::vector<std::uint64_t> counts(centers->size(), 0);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::uint8_t* descriptor = descriptors_.row(members[i]).data();
    std::array<std::uint64_t, kDescriptorSize>& sum = sums[assignment[i]];
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += descriptor[k];
    ++counts[assignment[i]];
  }
  for (std::size_t c = 0; c < centers->size(); ++c) {
    if (counts[c] == 0) continue;
    for (std::size_t k = 0; k < kDescriptorSize; ++k) {
      (*centers)[c][k] = static_cast<std::uint8_t>((sums[c][k] + counts[c] / 2) / counts[c]);
    }
  }
}

}  // namespace plumb
