// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/labelled_cells.h"

#include "image/parallel_for.h"
#include "plumbline/common/stopwatch.h"

namespace plumb {
namespace {

// Removing a vertex costs some four times as much as inserting one: beyond this share of moving
// landmarks all of them are inserted anew.
constexpr double kMaxShareMoved = 0.25;

// Landmarks whose rays one thread casts at a time.
constexpr int kCastsOfPart = 128;

// Cells that one thread weighs at a time.
constexpr int kWeightsOfPart = 1024;

}  // namespace

LabelledCells::LabelledCells(const SurfaceOptions& options)
    : options_(options), scene_(options), tetrahedra_(std::make_unique<Tetrahedra>(&cut_)) {}

void LabelledCells::Apply(const MapDelta& delta, SurfaceReport* report) {
  for (const CutNode node : changed_nodes_) is_changed_[node] = 0;
  changed_nodes_.clear();
  Stopwatch watch;
  const std::size_t num_before = scene_.num_placed();
  SceneChanges changes = scene_.Apply(delta, report);
  MarkReseen(changes);
  report->scene_s = watch.Restart();

  const double max_moved = kMaxShareMoved * static_cast<double>(num_before);
  report->is_rebuilt = num_before > 0 && static_cast<double>(changes.removed.size()) > max_moved;
  if (report->is_rebuilt) {
    Rebuild();
    changes.recast.clear();
  } else {
    tetrahedra_->Remove(changes.removed);
    InsertSlots(changes.inserted);
  }
  report->tetrahedra_s = watch.Restart();

  Cast(changes.recast, report);
  ConnectCreated();
  Weigh(report);
  report->weights_s = watch.Restart();

  cut_.Solve();
  for (const CutNode node : cut_.changed()) MarkChanged(node);
  for (const CutNode node : reseen_nodes_) MarkChanged(node);
  reseen_nodes_.clear();
  report->num_labels_changed = cut_.changed().size();
  report->cut_s = watch.Restart();

  redrawn_ = std::move(changes.redrawn);
  tetrahedra_->ClearChanges();
  report->num_cells = cut_.num_nodes();
  report->num_vertices = tetrahedra_->triangulation().number_of_vertices();
}

std::int64_t LabelledCells::Energy() const {
  return EnergyOf(options_, tetrahedra_->triangulation(), cut_);
}

void LabelledCells::Rebuild() {
  for (const Cell cell : tetrahedra_->triangulation().finite_cell_handles()) {
    if (cell->info().node != kNoCutNode) MarkChanged(cell->info().node);
  }
  cut_ = DynamicCut();
  tetrahedra_ = std::make_unique<Tetrahedra>(&cut_);
  InsertSlots(scene_.PlacedSlots());
}

void LabelledCells::InsertSlots(const std::vector<Slot>& slots) {
  std::vector<Tetrahedra::Place> places;
  places.reserve(slots.size());
  for (const Slot slot : slots) {
    places.push_back({slot, scene_.IdOf(slot), scene_.PlaceOf(slot)});
  }
  tetrahedra_->Insert(std::move(places));
}

void LabelledCells::Cast(const std::vector<Slot>& recast, SurfaceReport* report) {
  if (!tetrahedra_->HasCells()) return;
  std::vector<Slot> slots;
  std::vector<char> is_cast(scene_.num_slots(), 0);
  for (const std::vector<Slot>* some : {&tetrahedra_->touched(), &recast}) {
    for (const Slot slot : *some) {
      if (is_cast[slot] != 0 || tetrahedra_->VertexOf(slot) == Vertex()) continue;
      is_cast[slot] = 1;
      slots.push_back(slot);
    }
  }
  const auto num_slots = static_cast<int>(slots.size());
  std::vector<CastPart> parts(slots.size() / kCastsOfPart + 1);
  ParallelFor(options_.num_threads, num_slots, kCastsOfPart, [&](int begin, int end) {
    CastPart* part = &parts[static_cast<std::size_t>(begin / kCastsOfPart)];
    for (int i = begin; i < end; ++i) CastSlot(slots[static_cast<std::size_t>(i)], part);
  });
  for (const CastPart& part : parts) {
    for (const CutNode node : part.recounted) MarkChanged(node);
    reseen_nodes_.insert(reseen_nodes_.end(), part.reseen.begin(), part.reseen.end());
    tetrahedra_->AddNodes(part.new_cells);
    report->num_rays_cast += part.num_rays;
  }
  tetrahedra_->MeasureSpheres(options_.num_threads);
}

void LabelledCells::CastSlot(Slot slot, CastPart* part) const {
  scene_.RaysOf(slot, &part->rays);
  const Vertex vertex = tetrahedra_->VertexOf(slot);
  CastRays(tetrahedra_->triangulation(), vertex, part->rays, &part->star);
  const bool is_reseen = IsReseen(slot);
  for (std::size_t i = 0; i < part->star.cells.size(); ++i) {
    const Cell cell = part->star.cells[i];
    const CutNode node = cell->info().node;
    if (node == kNoCutNode) {
      part->new_cells.push_back(cell);
    } else if (part->star.IsChanged(i, vertex)) {
      part->recounted.push_back(node);
    } else if (is_reseen) {
      part->reseen.push_back(node);
    }
  }
  part->num_rays += part->rays.size();
}

void LabelledCells::ConnectCreated() {
  for (const CutNode node : tetrahedra_->created()) {
    const Cell cell = tetrahedra_->CellOf(node);
    for (int i = 0; i < 4; ++i) {
      const Cell neighbor = cell->neighbor(i);
      const CutNode other = neighbor->info().node;
      const auto slot = static_cast<std::uint32_t>(i);
      if (other == kNoCutNode || cut_.NeighborOf(node, slot) != kNoCutNode) continue;
      cut_.Connect(node, slot, other, static_cast<std::uint32_t>(neighbor->index(cell)));
      MarkChanged(other);
    }
  }
}

void LabelledCells::Weigh(SurfaceReport* report) {
  for (const std::vector<CutNode>* nodes :
       {&tetrahedra_->created(), &tetrahedra_->destroyed(), &tetrahedra_->bereft()}) {
    for (const CutNode node : *nodes) MarkChanged(node);
  }
  std::vector<CellWeights> weights(changed_nodes_.size());
  ParallelFor(options_.num_threads,
              static_cast<int>(weights.size()),
              kWeightsOfPart,
              [&](int begin, int end) {
                for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end);
                     ++i) {
                  weights[i] = WeightsOf(changed_nodes_[i]);
                }
              });
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const CutNode node = changed_nodes_[i];
    if (tetrahedra_->CellOf(node) == Cell()) continue;
    ++report->num_cells_changed;
    cut_.SetTerminal(node, weights[i].terminal);
    for (std::uint32_t k = 0; k < DynamicCut::kDegree; ++k) {
      if (weights[i].faces[k]) cut_.SetCapacity(node, k, *weights[i].faces[k]);
    }
  }
}

// Of a face between two changed cells, with one of them.
LabelledCells::CellWeights LabelledCells::WeightsOf(CutNode node) const {
  CellWeights weights;
  const Cell cell = tetrahedra_->CellOf(node);
  if (cell == Cell()) return weights;
  weights.terminal = TerminalOf(options_, tetrahedra_->triangulation(), cell);
  for (std::uint32_t k = 0; k < DynamicCut::kDegree; ++k) {
    const CutNode neighbor = cut_.NeighborOf(node, k);
    if (neighbor == kNoCutNode || (IsChanged(neighbor) && neighbor < node)) continue;
    weights.faces[k] = FaceWeightOf(options_, cell, static_cast<int>(k));
  }
  return weights;
}

void LabelledCells::MarkChanged(CutNode node) {
  if (is_changed_.size() <= node) is_changed_.resize(node + 1, 0);
  if (is_changed_[node] != 0) return;
  is_changed_[node] = 1;
  changed_nodes_.push_back(node);
}

void LabelledCells::MarkReseen(const SceneChanges& changes) {
  for (const Slot slot : reseen_) is_reseen_[slot] = 0;
  reseen_ = changes.inserted;
  reseen_.insert(reseen_.end(), changes.recast.begin(), changes.recast.end());
  is_reseen_.resize(scene_.num_slots(), 0);
  for (const Slot slot : reseen_) is_reseen_[slot] = 1;
}

}  // namespace plumb
