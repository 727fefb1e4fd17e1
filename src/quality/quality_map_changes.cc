// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a step changes: views, lens, blocks.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "plumbline/common/options.h"
#include "plumbline/common/stopwatch.h"
#include "quality/quality_map_impl.h"

namespace plumb {
namespace {

bool IsFinite(const Rigid3& transform) {
  return transform.rotation.coeffs().allFinite() && transform.translation.allFinite();
}

bool IsSame(const Rigid3& a, const Rigid3& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

bool IsSame(const MeshBlock& a, const MeshBlock& b) {
  const auto is_same = [](const MeshVertex& v, const MeshVertex& w) {
    return v.landmark == w.landmark && v.position_in_map == w.position_in_map && v.color == w.color;
  };
  return a.faces == b.faces &&
         std::equal(
             a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), is_same);
}

Eigen::AlignedBox3d BoxOf(const MeshBlock& block) {
  Eigen::AlignedBox3d box;
  for (const MeshVertex& vertex : block.vertices) {
    if (vertex.position_in_map.allFinite()) box.extend(vertex.position_in_map);
  }
  return box;
}

}  // namespace

QualityMap::Impl::Impl(const QualityOptions& options)
    : options_(options), noise_px_(options.default_noise_px) {
  ThrowIfProblems("quality", options.Problems());
}

QualityUpdate QualityMap::Impl::SetCamera(const Camera& camera) {
  const Stopwatch stopwatch;
  camera_ = camera;
  lens_ = std::make_shared<const internal::Lens>(camera);
  for (const auto& [photo, cam_from_map] : views_) {
    ForgetSight(photo);
    sights_.emplace(photo, internal::Sight(lens_, cam_from_map));
    changed_views_.insert(photo);
  }
  LookAnew();
  QualityUpdate update = Finish();
  update.seconds = stopwatch.Seconds();
  return update;
}

QualityUpdate QualityMap::Impl::Apply(const MapDelta& map_delta, const MeshDelta& mesh_delta) {
  const Stopwatch stopwatch;
  ApplyLens(map_delta);
  ApplyViews(map_delta);
  noise_.Apply(map_delta);
  ApplyMesh(mesh_delta);
  LookAnew();
  QualityUpdate update = Finish();
  update.seconds = stopwatch.Seconds();
  return update;
}

void QualityMap::Impl::ApplyLens(const MapDelta& delta) {
  if (!delta.lens || !camera_ || camera_->lens() == *delta.lens) return;
  try {
    const Camera& known = *camera_;
    camera_ = Camera(known.name(), known.width_px(), known.height_px(), known.model(), *delta.lens);
  } catch (const std::invalid_argument&) {
    return;  // The lens as known before is the better guess.
  }
  lens_ = std::make_shared<const internal::Lens>(*camera_);
  const std::map<PhotoId, Rigid3> views = std::move(views_);
  views_.clear();
  for (const auto& [photo, cam_from_map] : views) SetView({photo, {}, {}, cam_from_map});
}

void QualityMap::Impl::ApplyViews(const MapDelta& delta) {
  for (const PhotoId photo : delta.views_removed) RemoveView(photo);
  if (delta.is_snapshot) {
    std::set<PhotoId> gone;
    for (const auto& [photo, view] : views_) gone.insert(photo);
    for (const ViewState& view : delta.views_set) gone.erase(view.photo);
    for (const PhotoId photo : gone) RemoveView(photo);
  }
  for (const ViewState& view : delta.views_set) SetView(view);
}

void QualityMap::Impl::SetView(const ViewState& view) {
  if (!IsFinite(view.cam_from_map)) return RemoveView(view.photo);
  const auto found = views_.find(view.photo);
  if (found != views_.end() && IsSame(found->second, view.cam_from_map)) return;
  ForgetSight(view.photo);
  views_.insert_or_assign(view.photo, view.cam_from_map);
  if (lens_) sights_.emplace(view.photo, internal::Sight(lens_, view.cam_from_map));
  changed_views_.insert(view.photo);
}

void QualityMap::Impl::RemoveView(PhotoId photo) {
  if (views_.erase(photo) == 0) return;
  ForgetSight(photo);
  changed_views_.insert(photo);
}

void QualityMap::Impl::ForgetSight(PhotoId photo) {
  sights_.erase(photo);
  const auto found = blocks_of_view_.find(photo);
  if (found == blocks_of_view_.end()) return;
  for (const BlockId& id : found->second) {
    states_.at(id).rows.erase(photo);
    touched_blocks_.insert(id);
  }
  blocks_of_view_.erase(found);
}

void QualityMap::Impl::ApplyMesh(const MeshDelta& delta) {
  if (delta.is_snapshot) {
    std::set<BlockId> gone;
    for (const auto& [id, block] : blocks_) gone.insert(id);
    for (const MeshBlock& block : delta.blocks) gone.erase(block.id);
    for (const BlockId& id : gone) RemoveBlock(id);
  }
  for (const MeshBlock& block : delta.blocks) SetBlock(block);
  occluders_.Commit();
}

void QualityMap::Impl::SetBlock(const MeshBlock& block) {
  const auto known = blocks_.find(block.id);
  if (known != blocks_.end() && IsSame(known->second.mesh, block)) return;
  RemoveBlock(block.id);
  if (block.faces.empty()) return;
  QualityBlock& stored = blocks_[block.id];
  stored.mesh = block;
  stored.shapes = ShapesOf(block);
  BlockState& state = states_[block.id];
  state.box = BoxOf(block);
  occluders_.Set(stored.mesh);
  NoteChange(block.id, state.box);
}

void QualityMap::Impl::RemoveBlock(const BlockId& id) {
  const auto found = states_.find(id);
  if (found == states_.end()) return;
  NoteChange(id, found->second.box);
  for (const auto& [photo, row] : found->second.rows) blocks_of_view_.at(photo).erase(id);
  occluders_.Remove(id);
  states_.erase(found);
  blocks_.erase(id);
}

void QualityMap::Impl::NoteChange(const BlockId& id, const Eigen::AlignedBox3d& box) {
  changed_boxes_[id].extend(box);
  touched_blocks_.insert(id);
}

}  // namespace plumb
