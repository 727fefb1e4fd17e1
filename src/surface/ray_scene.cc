// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/ray_scene.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "surface/lattice.h"

namespace plumb {
namespace {

std::uint64_t HashOf(const Eigen::Vector3d& position) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    const double coordinate = position[i] + 0.0;  // -0 is 0.
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

SceneChanges RayScene::Apply(const MapDelta& delta, SurfaceReport* report) {
  report_ = report;
  unused_slots_.insert(unused_slots_.end(), freed_slots_.begin(), freed_slots_.end());
  freed_slots_.clear();
  SceneChanges changes;
  RemoveObservations(delta);
  RemoveLandmarks(delta, &changes);
  RemoveViews(delta);
  SetViews(delta);
  SetLandmarks(delta);
  AddObservations(delta);
  for (const Slot slot : dirty_) Settle(slot, &changes);
  dirty_.clear();
  for (const std::uint32_t view : changed_views_) {
    views_[view].is_changed = false;
    report->num_views_recast += views_[view].is_recast ? 1 : 0;
    views_[view].is_recast = false;
  }
  changed_views_.clear();
  report->num_rays = num_rays_;
  report_ = nullptr;
  return changes;
}

std::vector<Slot> RayScene::PlacedSlots() const {
  std::vector<Slot> slots;
  slots.reserve(num_placed_);
  for (Slot slot = 0; slot < landmarks_.size(); ++slot) {
    if (landmarks_[slot].is_placed) slots.push_back(slot);
  }
  return slots;
}

void RayScene::RaysOf(Slot slot, std::vector<SceneRay>* rays) const {
  rays->clear();
  const SceneLandmark& landmark = landmarks_[slot];
  const int pitch_exponent = CameraPitchExponent(landmark.distance_exponent);
  PhotoId last;
  for (const Ray& ray : landmark.rays) {
    const SceneView& view = views_[ray.view];
    if (ray.photo == last || !view.is_usable) continue;
    if ((view.center - landmark.position).squaredNorm() == 0.0) continue;
    last = ray.photo;
    rays->push_back({ray.photo, Snapped(view.center, pitch_exponent)});
  }
}

int RayScene::CameraPitchExponent(int distance_exponent) const {
  return distance_exponent - options_.camera_lattice_bits;
}

void RayScene::RemoveObservations(const MapDelta& delta) {
  for (const ObservationState& observation : delta.observations_removed) {
    const auto it = slot_of_landmark_.find(observation.landmark);
    if (it == slot_of_landmark_.end()) continue;
    SceneLandmark& landmark = landmarks_[it->second];
    const Ray ray{observation.photo, observation.feature_idx, 0};
    const auto found = std::lower_bound(landmark.rays.begin(), landmark.rays.end(), ray);
    if (found == landmark.rays.end() || ray < *found) continue;
    DetachFromView(found->view, it->second);
    landmark.rays.erase(found);
    landmark.has_new_rays = true;
    ++report_->num_rays_removed;
    --num_rays_;
    MarkDirty(it->second);
  }
}

void RayScene::RemoveLandmarks(const MapDelta& delta, SceneChanges* changes) {
  for (const LandmarkId id : delta.landmarks_removed) {
    const auto it = slot_of_landmark_.find(id);
    if (it == slot_of_landmark_.end()) continue;
    const Slot slot = it->second;
    SceneLandmark& landmark = landmarks_[slot];
    for (const Ray& ray : landmark.rays) DetachFromView(ray.view, slot);
    report_->num_rays_removed += landmark.rays.size();
    num_rays_ -= landmark.rays.size();
    ++report_->num_landmarks_removed;
    ForgetPosition(slot);
    if (landmark.is_placed) {
      changes->removed.push_back(slot);
      --num_placed_;
    }
    const bool is_dirty = landmark.is_dirty;
    landmark = SceneLandmark();
    landmark.is_dirty = is_dirty;  // Still listed; it has no id.
    slot_of_landmark_.erase(it);
    freed_slots_.push_back(slot);
  }
}

void RayScene::RemoveViews(const MapDelta& delta) {
  for (const PhotoId photo : delta.views_removed) {
    const auto it = view_of_photo_.find(photo);
    if (it == view_of_photo_.end()) continue;
    NoteView(it->second);
    SceneView& view = views_[it->second];
    view.is_usable = false;
    for (const Slot slot : view.landmarks) {
      std::vector<Ray>& rays = landmarks_[slot].rays;
      const auto gone = std::remove_if(
          rays.begin(), rays.end(), [&](const Ray& ray) { return ray.photo == photo; });
      const auto num_gone = static_cast<std::size_t>(rays.end() - gone);
      rays.erase(gone, rays.end());
      report_->num_rays_removed += num_gone;
      num_rays_ -= num_gone;
      landmarks_[slot].has_new_rays = true;
      MarkDirty(slot);
    }
    view.landmarks.clear();
  }
}

void RayScene::SetViews(const MapDelta& delta) {
  for (const ViewState& state : delta.views_set) {
    const std::uint32_t slot = ViewSlot(state.photo);
    SceneView& view = views_[slot];
    const Eigen::Vector3d center = state.cam_from_map.TargetOriginInSource();
    const bool is_usable = IsUsable(center);
    if (!is_usable) NoteProblem(SurfaceProblem::Kind::kViewNotFinite, {}, state.photo, {});
    if (is_usable == view.is_usable && (!is_usable || center == view.center)) continue;
    NoteView(slot);
    view.is_usable = is_usable;
    view.is_missed = !is_usable;
    view.center = is_usable ? center : Eigen::Vector3d::Zero();
    if (view.was_usable) ++report_->num_views_moved;
    for (const Slot landmark : view.landmarks) MarkDirty(landmark);
  }
}

void RayScene::SetLandmarks(const MapDelta& delta) {
  for (const LandmarkState& state : delta.landmarks_set) {
    const auto [it, is_new] = slot_of_landmark_.try_emplace(state.id, kNoSlot);
    if (is_new) {
      if (unused_slots_.empty()) {
        it->second = static_cast<Slot>(landmarks_.size());
        landmarks_.emplace_back();
      } else {
        it->second = unused_slots_.back();
        unused_slots_.pop_back();
      }
      landmarks_[it->second].id = state.id;
    }
    const Slot slot = it->second;
    SceneLandmark& landmark = landmarks_[slot];
    if (!IsUsable(state.position_in_map)) {
      NoteProblem(SurfaceProblem::Kind::kLandmarkNotFinite, state.id, {}, {});
    }
    ++(is_new ? report_->num_landmarks_added : report_->num_landmarks_moved);
    landmark.has_new_color = landmark.has_new_color || landmark.color != state.color;
    landmark.color = state.color;
    if (!is_new) ForgetPosition(slot);
    landmark.position = state.position_in_map;
    CheckDoubled(slot);
    MarkDirty(slot);
  }
}

void RayScene::AddObservations(const MapDelta& delta) {
  for (const ObservationState& observation : delta.observations_added) {
    const auto it = slot_of_landmark_.find(observation.landmark);
    if (it == slot_of_landmark_.end()) {
      NoteProblem(
          SurfaceProblem::Kind::kUnknownLandmark, observation.landmark, observation.photo, {});
      continue;
    }
    const std::uint32_t view = ViewSlot(observation.photo);
    if (!views_[view].is_usable && !std::exchange(views_[view].is_missed, true)) {
      NoteProblem(SurfaceProblem::Kind::kUnknownView, {}, observation.photo, {});
    }
    SceneLandmark& landmark = landmarks_[it->second];
    const Ray ray{observation.photo, observation.feature_idx, view};
    const auto place = std::lower_bound(landmark.rays.begin(), landmark.rays.end(), ray);
    if (place != landmark.rays.end() && !(ray < *place)) continue;
    landmark.rays.insert(place, ray);
    std::vector<Slot>& seen = views_[view].landmarks;
    seen.insert(std::upper_bound(seen.begin(), seen.end(), it->second), it->second);
    landmark.has_new_rays = true;
    ++report_->num_rays_added;
    ++num_rays_;
    MarkDirty(it->second);
  }
}

std::uint32_t RayScene::ViewSlot(PhotoId photo) {
  const auto [it, is_new] =
      view_of_photo_.try_emplace(photo, static_cast<std::uint32_t>(views_.size()));
  if (is_new) {
    views_.emplace_back();
    views_.back().photo = photo;
  }
  return it->second;
}

void RayScene::NoteView(std::uint32_t view) {
  SceneView& noted = views_[view];
  if (noted.is_changed) return;
  noted.is_changed = true;
  noted.was_usable = noted.is_usable;
  noted.old_center = noted.center;
  changed_views_.push_back(view);
}

void RayScene::DetachFromView(std::uint32_t view, Slot slot) {
  std::vector<Slot>& seen = views_[view].landmarks;
  const auto found = std::lower_bound(seen.begin(), seen.end(), slot);
  if (found != seen.end() && *found == slot) seen.erase(found);
}

void RayScene::MarkDirty(Slot slot) {
  if (landmarks_[slot].is_dirty) return;
  landmarks_[slot].is_dirty = true;
  dirty_.push_back(slot);
}

void RayScene::NoteProblem(SurfaceProblem::Kind kind,
                           LandmarkId landmark,
                           PhotoId photo,
                           LandmarkId other) {
  report_->problems.push_back({kind, landmark, other, photo});
}

void RayScene::CheckDoubled(Slot slot) {
  const Eigen::Vector3d& position = landmarks_[slot].position;
  if (!IsUsable(position)) return;
  const auto [it, is_first] = slot_at_position_.try_emplace(HashOf(position), slot);
  if (is_first || it->second == slot || landmarks_[it->second].position != position) return;
  NoteProblem(
      SurfaceProblem::Kind::kLandmarkDoubled, landmarks_[slot].id, {}, landmarks_[it->second].id);
}

void RayScene::ForgetPosition(Slot slot) {
  const auto it = slot_at_position_.find(HashOf(landmarks_[slot].position));
  if (it != slot_at_position_.end() && it->second == slot) slot_at_position_.erase(it);
}

RayScene::Placement RayScene::PlacementOf(const SceneLandmark& landmark) {
  Placement placement;
  if (!landmark.id.IsValid() || !IsUsable(landmark.position)) return placement;
  for (const Ray& ray : landmark.rays) {
    const SceneView& view = views_[ray.view];
    if (!view.is_usable) continue;
    const double squared_distance = (view.center - landmark.position).squaredNorm();
    if (squared_distance == 0.0) {
      NoteProblem(SurfaceProblem::Kind::kCameraOnLandmark, landmark.id, ray.photo, {});
      continue;
    }
    const int exponent = DistanceExponent(squared_distance);
    if (placement.is_placed && exponent >= placement.distance_exponent) continue;
    placement = {true, exponent};
  }
  return placement;
}

// Whether a ray starts at another place on the camera's lattice than before the delta.
bool RayScene::HasMovedCamera(const SceneLandmark& landmark, int distance_exponent) {
  const int pitch_exponent = CameraPitchExponent(distance_exponent);
  bool has_moved = false;
  for (const Ray& ray : landmark.rays) {
    SceneView& view = views_[ray.view];
    if (!view.is_changed) continue;
    if (view.was_usable == view.is_usable &&
        Snapped(view.center, pitch_exponent) == Snapped(view.old_center, pitch_exponent)) {
      continue;
    }
    view.is_recast = true;
    has_moved = true;
  }
  return has_moved;
}

// Finds what the delta has done to a landmark.
void RayScene::Settle(Slot slot, SceneChanges* changes) {
  SceneLandmark& landmark = landmarks_[slot];
  landmark.is_dirty = false;
  const bool has_new_rays = std::exchange(landmark.has_new_rays, false);
  const bool has_new_color = std::exchange(landmark.has_new_color, false);
  if (!landmark.id.IsValid()) return;
  const bool was_placed = landmark.is_placed;
  const int old_exponent = landmark.distance_exponent;
  const Eigen::Vector3d old_place = landmark.place;
  const Eigen::Vector3d old_mesh_position = landmark.mesh_position;

  const Placement placement = PlacementOf(landmark);
  landmark.is_placed = placement.is_placed;
  if (!placement.is_placed) {
    if (!was_placed) return;
    changes->removed.push_back(slot);
    --num_placed_;
    return;
  }
  landmark.distance_exponent = placement.distance_exponent;
  const int pitch_exponent =
      PitchExponent(placement.distance_exponent, options_.landmark_lattice_bits, landmark.position);
  landmark.place = Snapped(landmark.position, pitch_exponent, LatticeOffset(landmark.id));
  landmark.mesh_position = Snapped(landmark.position, pitch_exponent - options_.mesh_lattice_bits);
  const bool has_moved_camera = was_placed && HasMovedCamera(landmark, placement.distance_exponent);
  if (!was_placed) {
    changes->inserted.push_back(slot);
    ++num_placed_;
  } else if (landmark.place != old_place) {
    changes->removed.push_back(slot);
    changes->inserted.push_back(slot);
    ++report_->num_landmarks_reinserted;
  } else if (has_new_rays || old_exponent != placement.distance_exponent || has_moved_camera) {
    changes->recast.push_back(slot);
  }
  if (!was_placed || has_new_color || landmark.mesh_position != old_mesh_position) {
    changes->redrawn.push_back(slot);
  }
}

}  // namespace plumb
