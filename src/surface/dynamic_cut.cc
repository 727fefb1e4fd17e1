// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/dynamic_cut.h"

#include <algorithm>
#include <limits>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();

}  // namespace

CutNode DynamicCut::AddNode() {
  CutNode node = kNoCutNode;
  if (unused_.empty()) {
    node = static_cast<CutNode>(nodes_.size());
    PLUMB_CHECK_LT(nodes_.size(), std::size_t{kNoArc} / kDegree);
    nodes_.emplace_back();
  } else {
    node = unused_.back();
    unused_.pop_back();
  }
  nodes_[node].is_used = true;
  return node;
}

void DynamicCut::RemoveNode(CutNode node) {
  Node& gone = nodes_[node];
  PLUMB_CHECK(gone.is_used);
  OrphanChildren(node);
  for (std::uint32_t slot = 0; slot < kDegree; ++slot) {
    const std::uint32_t sister = gone.sister[slot];
    if (sister == kNoArc) continue;
    Node& other = nodes_[NodeOf(sister)];
    std::int32_t& back = other.residual[SlotOf(sister)];
    // Both residuals add up to twice the capacity; what the other one lacks of it flows to `gone`.
    other.excess += (gone.residual[slot] - back) / 2;
    back = 0;
    other.sister[SlotOf(sister)] = kNoArc;
    Touch(NodeOf(sister));
  }
  const bool is_touched = gone.is_touched;  // Still in the list.
  gone = Node();
  gone.is_touched = is_touched;
  unused_.push_back(node);
}

void DynamicCut::SetTerminal(CutNode node, std::int32_t source_minus_sink) {
  Node& changed = nodes_[node];
  if (changed.terminal == source_minus_sink) return;
  changed.excess += source_minus_sink - changed.terminal;
  changed.terminal = source_minus_sink;
  Touch(node);
}

void DynamicCut::Connect(CutNode a, std::uint32_t slot_of_a, CutNode b, std::uint32_t slot_of_b) {
  PLUMB_CHECK_EQ(nodes_[a].sister[slot_of_a], kNoArc);
  PLUMB_CHECK_EQ(nodes_[b].sister[slot_of_b], kNoArc);
  nodes_[a].sister[slot_of_a] = kDegree * b + slot_of_b;
  nodes_[b].sister[slot_of_b] = kDegree * a + slot_of_a;
}

void DynamicCut::SetCapacity(CutNode node, std::uint32_t slot, std::int32_t capacity) {
  Node& a = nodes_[node];
  PLUMB_CHECK(a.sister[slot] != kNoArc);
  PLUMB_CHECK_GE(capacity, 0);
  const std::uint32_t sister = a.sister[slot];
  Node& b = nodes_[NodeOf(sister)];
  std::int32_t& forth = a.residual[slot];
  std::int32_t& back = b.residual[SlotOf(sister)];
  const std::int32_t old_capacity = (forth + back) / 2;
  if (old_capacity == capacity) return;
  const std::int32_t flow = old_capacity - forth;  // From a to b.
  const std::int32_t kept = std::clamp(flow, -capacity, capacity);
  forth = capacity - kept;
  back = capacity + kept;
  a.excess += flow - kept;
  b.excess -= flow - kept;
  Touch(node);
  Touch(NodeOf(sister));
}

CutNode DynamicCut::NeighborOf(CutNode node, std::uint32_t slot) const {
  const std::uint32_t sister = nodes_[node].sister[slot];
  return sister == kNoArc ? kNoCutNode : NodeOf(sister);
}

std::int64_t DynamicCut::Flow() const {
  std::int64_t flow = 0;
  for (const Node& node : nodes_) {
    // Of a sink capacity -terminal, -excess is left.
    const std::int32_t sink = std::max(-node.terminal, 0);
    flow += sink - std::max(-node.excess, 0);
  }
  return flow;
}

std::size_t DynamicCut::num_bytes() const {
  const std::size_t num_listed = unused_.capacity() + touched_.capacity() + active_.capacity() +
                                 orphans_.capacity() + noted_.capacity() + changed_.capacity();
  return nodes_.capacity() * sizeof(Node) + num_listed * sizeof(CutNode);
}

void DynamicCut::Solve() {
  if (time_ > kFar / 2) {
    for (Node& node : nodes_) node.stamp = 0;
    time_ = 0;
  }
  ++time_;
  RepairTouched();
  while (active_begin_ < active_.size()) {
    const CutNode node = active_[active_begin_++];
    // It stays marked as active while it is scanned, so that it is not listed twice.
    while (nodes_[node].tree != Tree::kNone) {
      const std::uint32_t arc = Grow(node);
      if (arc == kNoArc) break;
      ++time_;
      Augment(arc);
      AdoptOrphans();
    }
    nodes_[node].is_active = false;
  }
  active_.clear();
  active_begin_ = 0;
  NoteChanges();
}

void DynamicCut::Touch(CutNode node) {
  if (nodes_[node].is_touched) return;
  nodes_[node].is_touched = true;
  touched_.push_back(node);
}

void DynamicCut::NoteChanges() {
  changed_.clear();
  for (const CutNode node : noted_) {
    Node& noted = nodes_[node];
    noted.is_noted = false;
    const bool is_at_source = noted.tree == Tree::kSource;
    if (noted.is_at_source == is_at_source || !noted.is_used) continue;
    noted.is_at_source = is_at_source;
    changed_.push_back(node);
  }
  noted_.clear();
}

}  // namespace plumb
