// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "plumbline/map/map_delta.h"
#include "plumbline/surface/surface_options.h"
#include "plumbline/surface/surface_report.h"
#include "surface/cell_weights.h"
#include "surface/dynamic_cut.h"
#include "surface/ray_cast.h"
#include "surface/ray_scene.h"
#include "surface/tetrahedra.h"

namespace plumb {

// The scene, its tetrahedra, and which of them are free: all that comes before the mesh. Kept up
// to date delta by delta; a function of the map's content.
class LabelledCells {
 public:
  explicit LabelledCells(const SurfaceOptions& options);

  void Apply(const MapDelta& delta, SurfaceReport* report);

  std::int64_t Energy() const;

  const RayScene& scene() const { return scene_; }
  const Tetrahedra& tetrahedra() const { return *tetrahedra_; }
  const DynamicCut& cut() const { return cut_; }
  const SurfaceOptions& options() const { return options_; }

  // By the last Apply: nodes whose cells are gone, other, or stand otherwise to the mesh (their
  // label, a neighbour, or the rays of a landmark of theirs changed), each once; and landmarks
  // drawn elsewhere.
  const std::vector<CutNode>& changed_nodes() const { return changed_nodes_; }
  bool IsChanged(CutNode node) const { return node < is_changed_.size() && is_changed_[node] != 0; }
  const std::vector<Slot>& redrawn() const { return redrawn_; }
  // Whether the last Apply changed a landmark's place or rays.
  bool IsReseen(Slot slot) const { return slot < is_reseen_.size() && is_reseen_[slot] != 0; }

 private:
  // What one thread finds while it casts rays.
  struct CastPart {
    std::vector<CutNode> recounted;  // Whose counts changed.
    std::vector<CutNode> reseen;     // With a landmark whose rays changed; the same ones may be.
    std::vector<Cell> new_cells;     // They have no node yet.
    std::size_t num_rays = 0;
    std::vector<SceneRay> rays;  // Of the landmark at hand, as is the star.
    RayStar star;
  };

  struct CellWeights {
    std::int32_t terminal = 0;
    std::array<std::optional<std::int32_t>, DynamicCut::kDegree> faces;  // To be set.
  };

  void Rebuild();
  void InsertSlots(const std::vector<Slot>& slots);
  void Cast(const std::vector<Slot>& recast, SurfaceReport* report);
  void CastSlot(Slot slot, CastPart* part) const;
  void ConnectCreated();
  void Weigh(SurfaceReport* report);
  CellWeights WeightsOf(CutNode node) const;
  void MarkChanged(CutNode node);
  void MarkReseen(const SceneChanges& changes);

  SurfaceOptions options_;
  RayScene scene_;
  DynamicCut cut_;
  std::unique_ptr<Tetrahedra> tetrahedra_;
  std::vector<char> is_changed_;  // By node.
  std::vector<CutNode> changed_nodes_;
  std::vector<CutNode> reseen_nodes_;  // Their weights are as they were, unless they are changed.
  std::vector<Slot> redrawn_;
  std::vector<char> is_reseen_;  // By slot.
  std::vector<Slot> reseen_;
};

}  // namespace plumb
