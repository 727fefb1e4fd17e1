// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "plumbline/surface/mesh_delta.h"
#include "plumbline/surface/surface_options.h"
#include "surface/face_pool.h"
#include "surface/face_support.h"
#include "surface/islands.h"
#include "surface/labelled_cells.h"
#include "surface/spikes.h"

namespace plumb {

// The mesh between free and occupied cells, in blocks. Kept up to date from what LabelledCells
// says has changed.
class SurfaceMesh {
 public:
  explicit SurfaceMesh(const SurfaceOptions& options);

  // Gives what changed in the mesh; all but the numbers of the delta.
  MeshDelta Update(const LabelledCells& cells);

  // The whole mesh; all but the numbers of the delta. `scene` is that of the last update.
  MeshDelta Snapshot(const RayScene& scene) const;

  std::size_t num_faces() const { return num_published_; }
  std::size_t num_checked() const { return num_checked_; }  // By the last update.

 private:
  // A face between free and occupied at a changed cell.
  struct BorderFace {
    std::uint32_t arc = kNoFaceArc;  // That of the occupied side.
    FaceSlots slots = {kNoSlot, kNoSlot, kNoSlot};
    FaceIdx known = kNoFace;  // The detached face that it is.
    bool is_checked = false;  // It is new, or a corner of it is reseen.
    bool is_kept = false;
  };

  // What one thread finds at changed cells.
  struct BorderPart {
    std::vector<FaceIdx> attached;  // Some of them twice.
    std::vector<BorderFace> border;
  };

  std::vector<BorderFace> FindBorder(const LabelledCells& cells);
  void FindAt(const LabelledCells& cells, CutNode node, BorderPart* part) const;
  void Decide(const LabelledCells& cells, std::vector<BorderFace>* border);
  void AttachFaces(const RayScene& scene, const std::vector<BorderFace>& border);
  void RemoveDetached();
  void AddFace(const RayScene& scene, std::uint32_t arc, const FaceSlots& slots);
  std::vector<FaceIdx> FindCandidates(const RayScene& scene);
  bool IsShown(const Face& face) const { return !face.is_island && !spikes_.HasSpike(face.slots); }
  void SendRedrawn(const LabelledCells& cells);
  void UpdateBlock(const RayScene& scene, FaceIdx face);
  std::vector<MeshBlock> MakeBlocks(const RayScene& scene, const std::vector<BlockId>& ids) const;
  void Publish(const RayScene& scene, const std::vector<FaceIdx>& faces, MeshDelta* delta);
  BlockId BlockOf(const RayScene& scene, const FaceSlots& slots) const;
  MeshBlock MakeBlock(const RayScene& scene, const BlockId& id) const;

  double block_side_;  // In map units.
  int num_threads_;
  double max_edge_ratio_;
  IslandFinder islands_;
  SpikeFinder spikes_;
  FacePool pool_;
  std::size_t num_published_ = 0;
  std::size_t num_checked_ = 0;

  // Of the update under way.
  std::map<FaceKey, BlockId> unpublished_;  // Were in the mesh that was last sent.
  std::vector<FaceIdx> detached_;           // Some of them attached again.
  std::vector<FaceIdx> added_;
  std::vector<Slot> touched_slots_;  // Of faces that came or went.
  std::vector<Slot> checked_slots_;  // Of faces that were there, but are otherwise.
  std::set<BlockId> dirty_blocks_;
};

}  // namespace plumb
