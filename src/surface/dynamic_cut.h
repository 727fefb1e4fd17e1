// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

using CutNode = std::uint32_t;
constexpr CutNode kNoCutNode = 0xFFFFFFFF;

// A minimum cut in a graph whose nodes have at most four neighbours each, kept up to date while
// the graph changes: search trees of Boykov and Kolmogorov (PAMI 26(9), 2004) that outlive a solve,
// with flow and trees repaired where capacities changed (Kohli and Torr, ICCV 2005). As the degree
// is fixed, arcs are numbers (4 * node + slot) and a node that goes leaves nothing behind; a
// graph of arc lists grows with every change instead.
//
// Capacities are whole numbers, so flows are exact. The cut is the one with the fewest nodes at the
// source, which is unique: all that the source can still reach. Labels thus depend
// on the graph alone. Not thread-safe.
class DynamicCut {
 public:
  static constexpr std::uint32_t kDegree = 4;
  static constexpr std::uint32_t kNoArc = 0xFFFFFFFF;

  static CutNode NodeOf(std::uint32_t arc) { return arc / kDegree; }
  static std::uint32_t SlotOf(std::uint32_t arc) { return arc % kDegree; }

  // An unconnected node without terminal capacity. Numbers of removed nodes are used again.
  CutNode AddNode();

  // Its neighbours get the flow back that went through it.
  void RemoveNode(CutNode node);

  // Capacity from the source minus capacity to the sink; what both have in common changes
  // no cut.
  void SetTerminal(CutNode node, std::int32_t source_minus_sink);

  // Makes the two slots one edge without capacity. Both must be empty.
  void Connect(CutNode a, std::uint32_t slot_of_a, CutNode b, std::uint32_t slot_of_b);

  // Of the edge at `slot`, in both directions; the slot must be connected.
  void SetCapacity(CutNode node, std::uint32_t slot, std::int32_t capacity);

  // kNoCutNode if the slot is empty.
  CutNode NeighborOf(CutNode node, std::uint32_t slot) const;

  // The edge's other end; kNoArc if the slot is empty.
  std::uint32_t SisterOf(std::uint32_t arc) const {
    return nodes_[NodeOf(arc)].sister[SlotOf(arc)];
  }

  // Brings flow and labels up to date with all changes since the last call.
  void Solve();

  // Of the last Solve; false for a node added since.
  bool IsAtSource(CutNode node) const { return nodes_[node].is_at_source; }

  // Nodes whose label the last Solve changed.
  const std::vector<CutNode>& changed() const { return changed_; }

  // Maximal flow with what both terminals of a node have in common left out: the sum of what flows
  // into the sink. For tests; walks over all nodes.
  std::int64_t Flow() const;

  std::size_t num_nodes() const { return nodes_.size() - unused_.size(); }
  std::size_t num_bytes() const;

 private:
  enum class Tree : std::uint8_t { kNone, kSource, kSink };
  // Where the path to the node's terminal leads first: a slot, or one of these.
  static constexpr std::uint8_t kTerminal = 4;
  static constexpr std::uint8_t kOrphan = 5;

  struct Node {
    std::array<std::uint32_t, kDegree> sister = {kNoArc, kNoArc, kNoArc, kNoArc};
    std::array<std::int32_t, kDegree> residual = {0, 0, 0, 0};  // Of the arc out of the node.
    std::int32_t terminal = 0;
    std::int32_t excess = 0;  // terminal minus what flows out: residual from source or to sink.
    std::uint32_t stamp = 0;  // When `distance` was last known to be right.
    std::uint32_t distance = 0;
    Tree tree = Tree::kNone;
    std::uint8_t parent = kOrphan;
    bool is_used = false;
    bool is_touched = false;
    bool is_active = false;
    bool is_noted = false;
    bool is_at_source = false;
  };

  std::int32_t& ResidualOf(std::uint32_t arc) { return nodes_[NodeOf(arc)].residual[SlotOf(arc)]; }

  void Touch(CutNode node);
  void SetActive(CutNode node);
  void SetTree(CutNode node, Tree tree, std::uint8_t parent);
  void MakeOrphan(CutNode node);
  void OrphanChildren(CutNode node);
  void LeaveTree(CutNode node);
  bool HasValidParent(CutNode node) const;
  void RepairTouched();
  void RepairNode(CutNode node);
  std::uint32_t Grow(CutNode node);
  void Augment(std::uint32_t arc_to_sink_tree);
  std::int32_t Bottleneck(CutNode node, Tree tree) const;
  void Push(CutNode node, Tree tree, std::int32_t amount);
  void AdoptOrphans();
  void Adopt(CutNode node);
  std::uint32_t DistanceOf(CutNode node) const;
  void StampPath(CutNode node, std::uint32_t distance);
  void Release(CutNode node);
  void NoteChanges();

  std::vector<Node> nodes_;
  std::vector<CutNode> unused_;
  std::vector<CutNode> touched_;
  std::vector<CutNode> active_;  // First in, first out from active_begin_ on.
  std::size_t active_begin_ = 0;
  std::vector<CutNode> orphans_;
  std::size_t orphans_begin_ = 0;
  std::vector<CutNode> noted_;  // Whose tree was changed in this Solve.
  std::vector<CutNode> changed_;
  std::uint32_t time_ = 0;
};

}  // namespace plumb
