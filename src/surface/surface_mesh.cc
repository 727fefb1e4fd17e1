// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "image/parallel_for.h"
#include "surface/outward_face.h"

namespace plumb {
namespace {

// What one thread looks at, at a time.
constexpr int kNodesOfPart = 2048;
constexpr int kFacesOfPart = 512;

std::int32_t BlockIndex(double position, double side) {
  constexpr double kLimit =
      std::numeric_limits<std::int32_t>::max() - 2;  // Neighbours have ids too.
  return static_cast<std::int32_t>(std::clamp(std::floor(position / side), -kLimit, kLimit));
}

}  // namespace

SurfaceMesh::SurfaceMesh(const SurfaceOptions& options)
    : block_side_(options.block_side),
      num_threads_(options.num_threads),
      max_edge_ratio_(options.max_edge_ratio),
      islands_(options.min_island_faces),
      spikes_(options.max_spike_ratio) {}

MeshDelta SurfaceMesh::Update(const LabelledCells& cells) {
  std::vector<BorderFace> border = FindBorder(cells);
  Decide(cells, &border);
  AttachFaces(cells.scene(), border);
  RemoveDetached();
  MeshDelta delta;
  Publish(cells.scene(), FindCandidates(cells.scene()), &delta);
  SendRedrawn(cells);
  delta.blocks = MakeBlocks(cells.scene(), {dirty_blocks_.begin(), dirty_blocks_.end()});
  unpublished_.clear();
  added_.clear();
  touched_slots_.clear();
  checked_slots_.clear();
  dirty_blocks_.clear();
  return delta;
}

MeshDelta SurfaceMesh::Snapshot(const RayScene& scene) const {
  MeshDelta snapshot;
  snapshot.is_snapshot = true;
  for (MeshBlock& block : MakeBlocks(scene, pool_.Blocks())) {
    if (block.faces.empty()) continue;
    for (std::size_t i = 0; i < block.faces.size(); ++i) {
      snapshot.faces_added.push_back(block.KeyOf(i));
    }
    snapshot.blocks.push_back(std::move(block));
  }
  std::sort(snapshot.faces_added.begin(), snapshot.faces_added.end());
  return snapshot;
}

// Detaches all faces that may have changed; most of them are attached again.
std::vector<SurfaceMesh::BorderFace> SurfaceMesh::FindBorder(const LabelledCells& cells) {
  const std::vector<CutNode>& nodes = cells.changed_nodes();
  std::vector<BorderPart> parts(nodes.size() / kNodesOfPart + 1);
  const auto num_nodes = static_cast<int>(nodes.size());
  ParallelFor(num_threads_, num_nodes, kNodesOfPart, [&](int begin, int end) {
    BorderPart* part = &parts[static_cast<std::size_t>(begin / kNodesOfPart)];
    for (int i = begin; i < end; ++i) FindAt(cells, nodes[static_cast<std::size_t>(i)], part);
  });
  std::vector<BorderFace> border;
  for (const BorderPart& part : parts) {
    border.insert(border.end(), part.border.begin(), part.border.end());
    for (const FaceIdx face : part.attached) {
      if (pool_.IsDetached(face)) continue;
      pool_.Detach(face);
      detached_.push_back(face);
    }
  }
  return border;
}

// A border face between two changed cells, at one of them.
void SurfaceMesh::FindAt(const LabelledCells& cells, CutNode node, BorderPart* part) const {
  const auto note_attached = [&](std::uint32_t arc) {
    if (pool_.AtArc(arc) != kNoFace) part->attached.push_back(pool_.AtArc(arc));
  };
  const DynamicCut& cut = cells.cut();
  const bool is_there = cells.tetrahedra().CellOf(node) != Cell();
  for (std::uint32_t i = 0; i < DynamicCut::kDegree; ++i) {
    const std::uint32_t arc = DynamicCut::kDegree * node + i;
    note_attached(arc);
    if (!is_there) continue;
    const std::uint32_t sister = cut.SisterOf(arc);
    note_attached(sister);
    const bool is_free = cut.IsAtSource(node);
    const bool is_hull = sister == DynamicCut::kNoArc;
    const CutNode neighbor = is_hull ? kNoCutNode : DynamicCut::NodeOf(sister);
    if ((is_hull || cut.IsAtSource(neighbor)) == is_free) continue;
    if (!is_hull && neighbor < node && cells.IsChanged(neighbor)) continue;
    const std::uint32_t occupied = is_free ? sister : arc;
    const Cell cell = cells.tetrahedra().CellOf(DynamicCut::NodeOf(occupied));
    part->border.push_back(
        {occupied, OutwardFace(cell, static_cast<int>(DynamicCut::SlotOf(occupied)))});
  }
}

// Which border faces stay in the mesh.
void SurfaceMesh::Decide(const LabelledCells& cells, std::vector<BorderFace>* border) {
  std::vector<std::size_t> num_checked(border->size() / kFacesOfPart + 1, 0);
  const auto num_faces = static_cast<int>(border->size());
  ParallelFor(num_threads_, num_faces, kFacesOfPart, [&](int begin, int end) {
    FaceSupport support(cells.scene(), max_edge_ratio_);
    for (int i = begin; i < end; ++i) {
      BorderFace& face = (*border)[static_cast<std::size_t>(i)];
      face.known = pool_.FindDetached(face.slots);
      face.is_checked = face.known == kNoFace || cells.IsReseen(face.slots[0]) ||
                        cells.IsReseen(face.slots[1]) || cells.IsReseen(face.slots[2]);
      if (face.is_checked) ++num_checked[static_cast<std::size_t>(begin / kFacesOfPart)];
      face.is_kept = !face.is_checked || support.IsSupported(face.slots);
    }
  });
  num_checked_ = std::accumulate(num_checked.begin(), num_checked.end(), std::size_t{0});
}

void SurfaceMesh::AttachFaces(const RayScene& scene, const std::vector<BorderFace>& border) {
  for (const BorderFace& face : border) {
    if (!face.is_kept) continue;
    if (face.known == kNoFace) {
      AddFace(scene, face.arc, face.slots);
      continue;
    }
    pool_.Attach(face.known, face.arc);
    if (face.is_checked) {
      checked_slots_.insert(checked_slots_.end(), face.slots.begin(), face.slots.end());
    }
  }
}

void SurfaceMesh::RemoveDetached() {
  for (const FaceIdx face : detached_) {
    if (!pool_.IsDetached(face)) continue;
    const Face& gone = pool_[face];
    touched_slots_.insert(touched_slots_.end(), gone.slots.begin(), gone.slots.end());
    if (gone.is_published) unpublished_[gone.key] = gone.block;
    pool_.Remove(face);
  }
  detached_.clear();
}

void SurfaceMesh::AddFace(const RayScene& scene, std::uint32_t arc, const FaceSlots& slots) {
  const FaceKey key = {scene.IdOf(slots[0]), scene.IdOf(slots[1]), scene.IdOf(slots[2])};
  added_.push_back(pool_.Add(arc, slots, key, BlockOf(scene, slots)));
  touched_slots_.insert(touched_slots_.end(), slots.begin(), slots.end());
}

// Published faces of landmarks that are drawn elsewhere, in the blocks they now lie in. What is not
// published stays in its block until it is.
void SurfaceMesh::SendRedrawn(const LabelledCells& cells) {
  for (const Slot slot : cells.redrawn()) {
    for (const FaceIdx face : pool_.AroundSlot(slot)) {
      if (!pool_[face].is_published) continue;
      dirty_blocks_.insert(pool_[face].block);
      UpdateBlock(cells.scene(), face);
      dirty_blocks_.insert(pool_[face].block);
    }
  }
}

void SurfaceMesh::UpdateBlock(const RayScene& scene, FaceIdx face) {
  const BlockId block = BlockOf(scene, pool_[face].slots);
  if (block != pool_[face].block) pool_.MoveTo(face, block);
}

// Faces that are new, or whose marks changed; some of them twice.
std::vector<FaceIdx> SurfaceMesh::FindCandidates(const RayScene& scene) {
  std::vector<FaceIdx> candidates = islands_.Update(touched_slots_, &pool_);
  candidates.insert(candidates.end(), added_.begin(), added_.end());
  std::vector<Slot> slots = touched_slots_;
  slots.insert(slots.end(), checked_slots_.begin(), checked_slots_.end());
  const std::vector<FaceIdx> marked = spikes_.Update(std::move(slots), scene, pool_);
  candidates.insert(candidates.end(), marked.begin(), marked.end());
  return candidates;
}

// Compares faces that are new or whose marks changed, and those that are gone, with what was sent.
void SurfaceMesh::Publish(const RayScene& scene,
                          const std::vector<FaceIdx>& faces,
                          MeshDelta* delta) {
  for (const FaceIdx idx : faces) {
    const Face& face = pool_[idx];
    if (face.is_published == IsShown(face)) continue;
    if (face.is_published) {
      unpublished_[face.key] = face.block;
      pool_.SetPublished(idx, false);
      continue;
    }
    pool_.SetPublished(idx, true);
    UpdateBlock(scene, idx);
    const auto before = unpublished_.find(face.key);
    if (before == unpublished_.end()) {
      delta->faces_added.push_back(face.key);
      dirty_blocks_.insert(face.block);
      continue;
    }
    if (before->second != face.block) dirty_blocks_.insert({before->second, face.block});
    unpublished_.erase(before);
  }
  for (const auto& [key, block] : unpublished_) {
    delta->faces_removed.push_back(key);
    dirty_blocks_.insert(block);
  }
  std::sort(delta->faces_added.begin(), delta->faces_added.end());
  num_published_ += delta->faces_added.size();
  num_published_ -= delta->faces_removed.size();
}

BlockId SurfaceMesh::BlockOf(const RayScene& scene, const FaceSlots& slots) const {
  const Eigen::Vector3d centroid =
      (scene.MeshPositionOf(slots[0]) + scene.MeshPositionOf(slots[1]) +
       scene.MeshPositionOf(slots[2])) /
      3.0;
  return {BlockIndex(centroid.x(), block_side_),
          BlockIndex(centroid.y(), block_side_),
          BlockIndex(centroid.z(), block_side_)};
}

std::vector<MeshBlock> SurfaceMesh::MakeBlocks(const RayScene& scene,
                                               const std::vector<BlockId>& ids) const {
  std::vector<MeshBlock> blocks(ids.size());
  ParallelFor(num_threads_, static_cast<int>(ids.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      blocks[i] = MakeBlock(scene, ids[i]);
    }
  });
  return blocks;
}

MeshBlock SurfaceMesh::MakeBlock(const RayScene& scene, const BlockId& id) const {
  MeshBlock block;
  block.id = id;
  std::vector<const Face*> faces;
  std::vector<std::pair<LandmarkId, Slot>> corners;
  for (const FaceIdx idx : pool_.InBlock(id)) {
    const Face& face = pool_[idx];
    if (!face.is_published) continue;
    faces.push_back(&face);
    for (std::size_t k = 0; k < 3; ++k) corners.emplace_back(face.key[k], face.slots[k]);
  }
  std::sort(
      faces.begin(), faces.end(), [](const Face* a, const Face* b) { return a->key < b->key; });
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  block.vertices.reserve(corners.size());
  for (const auto& [landmark, slot] : corners) {
    block.vertices.push_back({landmark, scene.MeshPositionOf(slot), scene.ColorOf(slot)});
  }
  block.faces.reserve(faces.size());
  for (const Face* face : faces) {
    std::array<std::uint32_t, 3> indices;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair<LandmarkId, Slot> corner(face->key[k], face->slots[k]);
      const auto it = std::lower_bound(corners.begin(), corners.end(), corner);
      indices[k] = static_cast<std::uint32_t>(it - corners.begin());
    }
    block.faces.push_back(indices);
  }
  return block;
}

}  // namespace plumb
