// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/dynamic_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "test/support/random.h"
#include "test/surface/fresh_cut.h"

namespace plumb {
namespace {

using test::FreshCut;
using test::Random;

// A graph that changes at random, kept both in a DynamicCut and as plain lists.
class ChangingGraph {
 public:
  explicit ChangingGraph(int seed) : random_(seed) {}

  void Change() {
    const int what = random_.Index(10);
    if (nodes_.size() < 8 || (what == 0 && nodes_.size() < 60)) {
      nodes_.push_back(cut_.AddNode());
      terminal_.resize(std::max<std::size_t>(terminal_.size(), nodes_.back() + 1), 0);
    } else if (what == 1) {
      Remove(static_cast<std::size_t>(random_.Index(static_cast<int>(nodes_.size()))));
    } else if (what <= 4) {
      const CutNode node = Any();
      terminal_[node] = random_.Index(3) == 0 ? 0 : random_.Index(41) - 20;
      cut_.SetTerminal(node, terminal_[node]);
    } else {
      ChangeEdge();
    }
  }

  void Solve() { cut_.Solve(); }

  // Flow and labels are those of a solve from nothing.
  void ExpectOptimal() const {
    FreshCut fresh(cut_.num_nodes());
    std::map<CutNode, int> index_of;
    for (const CutNode node : nodes_) {
      const int index = static_cast<int>(index_of.size());
      index_of[node] = index;
      fresh.SetTerminal(index, terminal_[node]);
    }
    for (const auto& [ends, edge] : edges_) {
      fresh.AddEdge(index_of.at(ends.first), index_of.at(ends.second), edge.capacity);
    }
    fresh.Solve();
    ASSERT_EQ(cut_.Flow(), fresh.flow());
    for (const CutNode node : nodes_) {
      ASSERT_EQ(cut_.IsAtSource(node), fresh.IsAtSource(index_of.at(node))) << node;
    }
  }

  const DynamicCut& cut() const { return cut_; }
  const std::vector<CutNode>& nodes() const { return nodes_; }

 private:
  struct Edge {
    std::uint32_t slot = 0;  // Of the first end.
    int capacity = 0;
  };

  CutNode Any() {
    return nodes_[static_cast<std::size_t>(random_.Index(static_cast<int>(nodes_.size())))];
  }

  void Remove(std::size_t idx) {
    const CutNode node = nodes_[idx];
    nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(idx));
    terminal_[node] = 0;
    for (auto it = edges_.begin(); it != edges_.end();) {
      const bool is_gone = it->first.first == node || it->first.second == node;
      it = is_gone ? edges_.erase(it) : std::next(it);
    }
    cut_.RemoveNode(node);
  }

  void ChangeEdge() {
    const CutNode a = Any();
    const CutNode b = Any();
    if (a == b) return;
    const std::pair<CutNode, CutNode> ends(std::min(a, b), std::max(a, b));
    auto it = edges_.find(ends);
    if (it == edges_.end()) {
      const std::uint32_t slot = FreeSlot(ends.first);
      const std::uint32_t other_slot = FreeSlot(ends.second);
      if (slot == DynamicCut::kDegree || other_slot == DynamicCut::kDegree) return;
      cut_.Connect(ends.first, slot, ends.second, other_slot);
      it = edges_.emplace(ends, Edge{slot, 0}).first;
    }
    it->second.capacity = random_.Index(4) == 0 ? 0 : random_.Index(15);
    cut_.SetCapacity(ends.first, it->second.slot, it->second.capacity);
  }

  std::uint32_t FreeSlot(CutNode node) const {
    std::uint32_t slot = 0;
    while (slot < DynamicCut::kDegree && cut_.NeighborOf(node, slot) != kNoCutNode) ++slot;
    return slot;
  }

  Random random_;
  DynamicCut cut_;
  std::vector<CutNode> nodes_;
  std::vector<int> terminal_;
  std::map<std::pair<CutNode, CutNode>, Edge> edges_;
};

TEST(DynamicCut, FindsTheLeastCutOfAChain) {
  DynamicCut cut;
  const CutNode a = cut.AddNode();
  const CutNode b = cut.AddNode();
  const CutNode c = cut.AddNode();
  cut.Connect(a, 0, b, 3);
  cut.Connect(b, 1, c, 2);
  cut.SetTerminal(a, 10);
  cut.SetTerminal(c, -10);
  cut.SetCapacity(a, 0, 4);
  cut.SetCapacity(b, 1, 3);
  cut.Solve();
  EXPECT_EQ(cut.Flow(), 3);
  EXPECT_TRUE(cut.IsAtSource(a));
  EXPECT_TRUE(cut.IsAtSource(b));
  EXPECT_FALSE(cut.IsAtSource(c));
  EXPECT_EQ(cut.NeighborOf(b, 1), c);
  EXPECT_EQ(cut.NeighborOf(b, 0), kNoCutNode);
}

// Either edge could be cut; the cut next to the source is the one that is named.
TEST(DynamicCut, GivesTheFewestNodesToTheSource) {
  DynamicCut cut;
  const CutNode a = cut.AddNode();
  const CutNode b = cut.AddNode();
  cut.Connect(a, 0, b, 0);
  cut.SetTerminal(a, 5);
  cut.SetTerminal(b, -5);
  cut.SetCapacity(a, 0, 5);
  cut.Solve();
  EXPECT_EQ(cut.Flow(), 5);
  EXPECT_FALSE(cut.IsAtSource(a));
  EXPECT_FALSE(cut.IsAtSource(b));
}

TEST(DynamicCut, EqualsAFreshSolveAfterEachOfTenThousandChanges) {
  ChangingGraph graph(/*seed=*/1);
  for (int step = 0; step < 10'000; ++step) {
    graph.Change();
    graph.Solve();
    graph.ExpectOptimal();
    if (HasFatalFailure()) FAIL() << "step " << step;
  }
}

TEST(DynamicCut, EqualsAFreshSolveAfterManyChangesAtOnce) {
  ChangingGraph graph(/*seed=*/2);
  for (int step = 0; step < 500; ++step) {
    for (int i = 0; i < 40; ++i) graph.Change();
    graph.Solve();
    graph.ExpectOptimal();
    if (HasFatalFailure()) FAIL() << "step " << step;
  }
}

TEST(DynamicCut, NamesTheNodesWhoseLabelChanged) {
  ChangingGraph graph(/*seed=*/3);
  std::map<CutNode, bool> labels;
  for (int step = 0; step < 2000; ++step) {
    graph.Change();
    graph.Solve();
    std::map<CutNode, bool> now;
    for (const CutNode node : graph.nodes()) now[node] = graph.cut().IsAtSource(node);
    const std::vector<CutNode>& changed = graph.cut().changed();
    for (const auto& [node, is_at_source] : now) {
      const auto before = labels.find(node);
      const bool was_at_source = before != labels.end() && before->second;
      const bool is_named = std::find(changed.begin(), changed.end(), node) != changed.end();
      if (before == labels.end()) continue;
      ASSERT_EQ(is_named, was_at_source != is_at_source) << step;
    }
    labels = now;
  }
}

TEST(DynamicCut, DoesNotGrowWhileNodesComeAndGo) {
  DynamicCut cut;
  const CutNode fixed = cut.AddNode();
  cut.SetTerminal(fixed, 5);
  std::size_t num_bytes = 0;
  for (int i = 0; i < 1000; ++i) {
    const CutNode node = cut.AddNode();
    cut.Connect(fixed, 0, node, 1);
    cut.SetCapacity(fixed, 0, 3);
    cut.SetTerminal(node, -4);
    cut.Solve();
    EXPECT_EQ(cut.Flow(), 3);
    cut.RemoveNode(node);
    cut.Solve();
    EXPECT_EQ(cut.Flow(), 0);
    if (i == 10) num_bytes = cut.num_bytes();
  }
  EXPECT_EQ(cut.num_bytes(), num_bytes);
  EXPECT_EQ(cut.num_nodes(), 1U);
}

TEST(DynamicCut, RefusesASlotThatIsTaken) {
  DynamicCut cut;
  const CutNode a = cut.AddNode();
  const CutNode b = cut.AddNode();
  cut.Connect(a, 0, b, 0);
  EXPECT_THROW(cut.Connect(a, 0, b, 1), std::logic_error);
  EXPECT_THROW(cut.SetCapacity(a, 1, 2), std::logic_error);
  EXPECT_THROW(cut.SetCapacity(a, 0, -1), std::logic_error);
}

}  // namespace
}  // namespace plumb
