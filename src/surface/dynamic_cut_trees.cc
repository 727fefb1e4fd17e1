// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The search trees of DynamicCut: growth, augmentation, adoption.
#include <algorithm>
#include <limits>

#include "surface/dynamic_cut.h"

namespace plumb {
namespace {

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void DynamicCut::SetActive(CutNode node) {
  if (nodes_[node].is_active) return;
  nodes_[node].is_active = true;
  active_.push_back(node);
}

void DynamicCut::SetTree(CutNode node, Tree tree, std::uint8_t parent) {
  Node& changed = nodes_[node];
  changed.parent = parent;
  if (changed.tree == tree) return;
  changed.tree = tree;
  if (changed.is_noted) return;
  changed.is_noted = true;
  noted_.push_back(node);
}

void DynamicCut::MakeOrphan(CutNode node) {
  nodes_[node].parent = kOrphan;
  orphans_.push_back(node);
}

void DynamicCut::OrphanChildren(CutNode node) {
  for (const std::uint32_t sister : nodes_[node].sister) {
    if (sister == kNoArc) continue;
    const Node& child = nodes_[NodeOf(sister)];
    if (child.tree != Tree::kNone && child.parent == SlotOf(sister)) MakeOrphan(NodeOf(sister));
  }
}

// Its children need another parent, and the tree it leaves may take it back later.
void DynamicCut::LeaveTree(CutNode node) {
  OrphanChildren(node);
  for (const std::uint32_t sister : nodes_[node].sister) {
    if (sister != kNoArc && nodes_[NodeOf(sister)].tree != Tree::kNone) SetActive(NodeOf(sister));
  }
}

// Whether the first step of the node's path still leads on.
bool DynamicCut::HasValidParent(CutNode node) const {
  const Node& child = nodes_[node];
  if (child.parent == kTerminal) return child.excess != 0;
  if (child.parent == kOrphan) return true;  // Listed already.
  const std::uint32_t sister = child.sister[child.parent];
  if (sister == kNoArc) return false;
  const Node& parent = nodes_[NodeOf(sister)];
  const std::int32_t residual =
      child.tree == Tree::kSource ? parent.residual[SlotOf(sister)] : child.residual[child.parent];
  return parent.tree == child.tree && residual > 0;
}

void DynamicCut::RepairTouched() {
  for (const CutNode node : touched_) {
    nodes_[node].is_touched = false;
    if (nodes_[node].is_used) RepairNode(node);
  }
  // A second pass, for a node may have left its tree after its child was looked at.
  for (const CutNode node : touched_) {
    const Node& repaired = nodes_[node];
    if (!repaired.is_used || repaired.tree == Tree::kNone) continue;
    if (!HasValidParent(node)) MakeOrphan(node);
  }
  touched_.clear();
  AdoptOrphans();
}

void DynamicCut::RepairNode(CutNode node) {
  Node& repaired = nodes_[node];
  if (repaired.excess != 0) {
    const Tree tree = repaired.excess > 0 ? Tree::kSource : Tree::kSink;
    if (repaired.tree != tree) LeaveTree(node);
    SetTree(node, tree, kTerminal);
    repaired.stamp = time_;
    repaired.distance = 1;
  }
  if (repaired.tree != Tree::kNone) SetActive(node);
}

// Takes in the free neighbours that the node can reach. Stops at a neighbour of the other tree:
// gives the arc that leads from the source's tree into the sink's, or kNoArc.
std::uint32_t DynamicCut::Grow(CutNode node) {
  const bool is_source = nodes_[node].tree == Tree::kSource;
  for (std::uint32_t slot = 0; slot < kDegree; ++slot) {
    const std::uint32_t sister = nodes_[node].sister[slot];
    if (sister == kNoArc) continue;
    const std::uint32_t forward = is_source ? kDegree * node + slot : sister;
    if (ResidualOf(forward) == 0) continue;
    const CutNode other = NodeOf(sister);
    Node& reached = nodes_[other];
    if (reached.tree == Tree::kNone) {
      SetTree(other, nodes_[node].tree, static_cast<std::uint8_t>(SlotOf(sister)));
      reached.stamp = nodes_[node].stamp;
      reached.distance = nodes_[node].distance + 1;
      SetActive(other);
    } else if (reached.tree != nodes_[node].tree) {
      return forward;
    } else if (reached.stamp <= nodes_[node].stamp && reached.distance > nodes_[node].distance &&
               reached.parent < kDegree) {
      // A shorter path to the terminal, which is no longer known to be wrong than the old one.
      reached.parent = static_cast<std::uint8_t>(SlotOf(sister));
      reached.stamp = nodes_[node].stamp;
      reached.distance = nodes_[node].distance + 1;
    }
  }
  return kNoArc;
}

std::int32_t DynamicCut::Bottleneck(CutNode node, Tree tree) const {
  std::int32_t amount = std::numeric_limits<std::int32_t>::max();
  while (nodes_[node].parent != kTerminal) {
    const Node& child = nodes_[node];
    const std::uint32_t sister = child.sister[child.parent];
    const Node& parent = nodes_[NodeOf(sister)];
    amount = std::min(
        amount,
        tree == Tree::kSource ? parent.residual[SlotOf(sister)] : child.residual[child.parent]);
    node = NodeOf(sister);
  }
  return std::min(amount, std::abs(nodes_[node].excess));
}

// Sends `amount` between the node and its terminal; saturated steps make orphans.
void DynamicCut::Push(CutNode node, Tree tree, std::int32_t amount) {
  const std::int32_t sign = tree == Tree::kSource ? 1 : -1;
  while (nodes_[node].parent != kTerminal) {
    Node& child = nodes_[node];
    const std::uint32_t sister = child.sister[child.parent];
    const CutNode next = NodeOf(sister);
    std::int32_t& down = nodes_[next].residual[SlotOf(sister)];
    std::int32_t& up = child.residual[child.parent];
    down -= sign * amount;
    up += sign * amount;
    if ((tree == Tree::kSource ? down : up) == 0) MakeOrphan(node);
    node = next;
  }
  nodes_[node].excess -= sign * amount;
  if (nodes_[node].excess == 0) MakeOrphan(node);
}

void DynamicCut::Augment(std::uint32_t arc_to_sink_tree) {
  const std::uint32_t sister = SisterOf(arc_to_sink_tree);
  const CutNode from = NodeOf(arc_to_sink_tree);
  const CutNode to = NodeOf(sister);
  const std::int32_t amount = std::min(
      {ResidualOf(arc_to_sink_tree), Bottleneck(from, Tree::kSource), Bottleneck(to, Tree::kSink)});
  ResidualOf(arc_to_sink_tree) -= amount;
  ResidualOf(sister) += amount;
  Push(from, Tree::kSource, amount);
  Push(to, Tree::kSink, amount);
}

void DynamicCut::AdoptOrphans() {
  while (orphans_begin_ < orphans_.size()) {
    const CutNode node = orphans_[orphans_begin_++];
    const Node& orphan = nodes_[node];
    if (orphan.is_used && orphan.tree != Tree::kNone && orphan.parent == kOrphan) Adopt(node);
  }
  orphans_.clear();
  orphans_begin_ = 0;
}

// Steps to the terminal; kFar if the path ends at an orphan.
std::uint32_t DynamicCut::DistanceOf(CutNode node) const {
  std::uint32_t steps = 0;
  while (true) {
    const Node& on_path = nodes_[node];
    if (on_path.parent == kOrphan) return kFar;
    if (on_path.parent == kTerminal) return steps + 1;
    if (on_path.stamp == time_) return steps + on_path.distance;
    ++steps;
    node = NodeOf(on_path.sister[on_path.parent]);
  }
}

void DynamicCut::StampPath(CutNode node, std::uint32_t distance) {
  while (nodes_[node].stamp != time_) {
    Node& on_path = nodes_[node];
    on_path.stamp = time_;
    on_path.distance = distance--;
    if (on_path.parent == kTerminal) return;
    node = NodeOf(on_path.sister[on_path.parent]);
  }
}

// Finds the neighbour with the shortest path to the terminal, or sets the node free.
void DynamicCut::Adopt(CutNode node) {
  Node& orphan = nodes_[node];
  std::uint32_t best_distance = kFar;
  std::uint32_t best_slot = kDegree;
  for (std::uint32_t slot = 0; slot < kDegree; ++slot) {
    const std::uint32_t sister = orphan.sister[slot];
    if (sister == kNoArc) continue;
    const Node& other = nodes_[NodeOf(sister)];
    const std::int32_t residual =
        orphan.tree == Tree::kSource ? other.residual[SlotOf(sister)] : orphan.residual[slot];
    if (residual == 0 || other.tree != orphan.tree) continue;
    const std::uint32_t distance = DistanceOf(NodeOf(sister));
    if (distance == kFar) continue;
    StampPath(NodeOf(sister), distance);
    if (distance < best_distance) {
      best_distance = distance;
      best_slot = slot;
    }
  }
  if (best_slot == kDegree) {
    Release(node);
    return;
  }
  orphan.parent = static_cast<std::uint8_t>(best_slot);
  orphan.stamp = time_;
  orphan.distance = best_distance + 1;
}

void DynamicCut::Release(CutNode node) {
  const Tree tree = nodes_[node].tree;
  for (std::uint32_t slot = 0; slot < kDegree; ++slot) {
    const std::uint32_t sister = nodes_[node].sister[slot];
    if (sister == kNoArc) continue;
    const CutNode other = NodeOf(sister);
    if (nodes_[other].tree != tree) continue;
    const std::int32_t residual = tree == Tree::kSource ? nodes_[other].residual[SlotOf(sister)]
                                                        : nodes_[node].residual[slot];
    if (residual > 0) SetActive(other);
    if (nodes_[other].parent == SlotOf(sister)) MakeOrphan(other);
  }
  SetTree(node, Tree::kNone, kOrphan);
}

}  // namespace plumb
