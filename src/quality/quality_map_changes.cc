// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a step changes: views, lens, blocks.
#include <algorithm>
#include <utility>

#include "image/parallel_for.h"
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

bool IsSame(const Camera& a, const Camera& b) {
  return a.width_px() == b.width_px() && a.height_px() == b.height_px() && a.model() == b.model() &&
         a.lens() == b.lens();
}

Eigen::AlignedBox3d BoxOf(const MeshBlock& block) {
  Eigen::AlignedBox3d box;
  for (const MeshVertex& vertex : block.vertices) {
    if (vertex.position_in_map.allFinite()) box.extend(vertex.position_in_map);
  }
  return box;
}

// Every second bit of a number of ten bits and so on for three axes (Morton, 1966).
std::uint32_t SpreadBits(std::uint32_t value) {
  value = (value | (value << 16U)) & 0x030000FFU;
  value = (value | (value << 8U)) & 0x0300F00FU;
  value = (value | (value << 4U)) & 0x030C30C3U;
  return (value | (value << 2U)) & 0x09249249U;
}

// Of each face along Morton's curve through the box.
std::vector<std::uint32_t> RanksAlongCurve(const std::vector<FaceShape>& shapes,
                                           const Eigen::AlignedBox3d& box) {
  constexpr double kSteps = 1023.0;
  std::vector<std::uint32_t> ranks(shapes.size(), 0);
  if (box.isEmpty()) return ranks;
  const double step = std::max(box.sizes().maxCoeff() / kSteps, 1e-300);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> face_by_code;
  face_by_code.reserve(shapes.size());
  for (std::uint32_t face = 0; face < shapes.size(); ++face) {
    const Eigen::Vector3d place = (shapes[face].center_in_map - box.min()) / step;
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = place[axis] > 0.0 ? std::min(place[axis], kSteps) : 0.0;
      code |= SpreadBits(static_cast<std::uint32_t>(along)) << static_cast<unsigned>(axis);
    }
    face_by_code.emplace_back(code, face);
  }
  std::sort(face_by_code.begin(), face_by_code.end());
  for (std::uint32_t rank = 0; rank < face_by_code.size(); ++rank) {
    ranks[face_by_code[rank].second] = rank;
  }
  return ranks;
}

}  // namespace

QualityMap::Impl::Impl(const QualityOptions& options)
    : options_(options), noise_px_(options.default_noise_px) {
  ThrowIfProblems("quality", options.Problems());
}

QualityUpdate QualityMap::Impl::SetCamera(const Camera& camera) {
  const Stopwatch stopwatch;
  given_camera_ = camera;
  UseCamera();
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

// The lens may be known before the camera is. An impossible one is left out: the lens as known
// before is the better guess.
void QualityMap::Impl::ApplyLens(const MapDelta& delta) {
  if (delta.is_snapshot && !delta.lens) refined_lens_.reset();
  if (delta.lens && (!given_camera_ || given_camera_->WithLens(*delta.lens))) {
    refined_lens_ = delta.lens;
  }
  UseCamera();
}

// Looks at everything anew if the camera is another one than before.
void QualityMap::Impl::UseCamera() {
  if (!given_camera_) return;
  const auto refined =
      refined_lens_ ? given_camera_->WithLens(*refined_lens_) : std::optional<Camera>();
  const Camera& camera = refined ? *refined : *given_camera_;
  if (camera_ && IsSame(*camera_, camera)) return;
  camera_ = camera;
  lens_ = std::make_shared<const internal::Lens>(camera);
  const std::map<PhotoId, Rigid3> views = std::exchange(views_, {});
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
  for (const auto& [id, state] : found->second) {
    state->rows.erase(photo);
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
  SetBlocks(delta.blocks);
}

void QualityMap::Impl::SetBlocks(const std::vector<MeshBlock>& blocks) {
  std::map<BlockId, BlockState*> fresh;  // If a block is named twice, as it is last.
  for (const MeshBlock& mesh : blocks) {
    const auto known = blocks_.find(mesh.id);
    if (known != blocks_.end() && known->second.mesh == mesh) continue;
    RemoveBlock(mesh.id);
    fresh.erase(mesh.id);
    if (mesh.faces.empty()) continue;
    QualityBlock& block = blocks_[mesh.id];
    block.mesh = mesh;
    BlockState& state = states_[mesh.id];
    state.block = &block;
    state.is_changed = true;
    fresh[mesh.id] = &state;
  }
  std::vector<BlockState*> states;
  for (const auto& [id, state] : fresh) states.push_back(state);
  ParallelFor(options_.num_threads, static_cast<int>(states.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) MeasureFaces(states[static_cast<std::size_t>(i)]);
  });
  std::vector<const MeshBlock*> meshes;
  for (const auto& [id, state] : fresh) {
    NoteChange(id, state->box);
    meshes.push_back(&state->block->mesh);
  }
  occluders_.Set(meshes, options_.num_threads);
}

void QualityMap::Impl::MeasureFaces(BlockState* state) {
  QualityBlock* block = state->block;
  block->shapes = ShapesOf(block->mesh);
  state->box = BoxOf(block->mesh);
  state->faces = internal::FaceArrays(block->shapes);
  state->ranks = RanksAlongCurve(block->shapes, state->box);
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
