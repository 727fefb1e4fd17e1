// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/spikes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <utility>

#include "common/median.h"

namespace plumb {
namespace {

constexpr std::size_t kMaxRays = 2;       // More confirm each other.
constexpr std::size_t kMinNeighbors = 3;  // Fewer tell of no plane.

}  // namespace

std::vector<FaceIdx> SpikeFinder::Update(std::vector<Slot> slots,
                                         const RayScene& scene,
                                         const FacePool& pool) {
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  is_spike_.resize(std::max(is_spike_.size(), scene.num_slots()), 0);
  std::vector<FaceIdx> changed;
  for (const Slot slot : slots) {
    const bool is_spike = StandsOut(slot, scene, pool);
    if (IsSpike(slot) == is_spike) continue;
    is_spike_[slot] = is_spike ? 1 : 0;
    const std::vector<FaceIdx>& around = pool.AroundSlot(slot);
    changed.insert(changed.end(), around.begin(), around.end());
  }
  return changed;
}

bool SpikeFinder::StandsOut(Slot slot, const RayScene& scene, const FacePool& pool) {
  if (pool.AroundSlot(slot).size() < kMinNeighbors - 1) return false;  // As when it is gone.
  scene.RaysOf(slot, &rays_);
  if (rays_.size() > kMaxRays) return false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const SceneRay& ray : rays_) {
    nearest = std::min(nearest, (ray.camera - scene.PlaceOf(slot)).norm());
  }
  return HeightOf(slot, scene, pool) > max_spike_ratio_ * nearest;
}

// Median height over the neighbours along the mean normal of the faces around, which larger faces
// say more of; in map units. The same whatever order the faces came in.
double SpikeFinder::HeightOf(Slot slot, const RayScene& scene, const FacePool& pool) {
  ring_ = pool.AroundSlot(slot);
  std::sort(
      ring_.begin(), ring_.end(), [&](FaceIdx a, FaceIdx b) { return pool[a].key < pool[b].key; });
  neighbors_.clear();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const FaceIdx face : ring_) {
    const FaceSlots& corners = pool[face].slots;
    const Eigen::Vector3d& first = scene.PlaceOf(corners[0]);
    normal += (scene.PlaceOf(corners[1]) - first).cross(scene.PlaceOf(corners[2]) - first);
    for (const Slot corner : corners) {
      if (corner != slot) neighbors_.push_back(corner);
    }
  }
  std::sort(neighbors_.begin(), neighbors_.end());
  neighbors_.erase(std::unique(neighbors_.begin(), neighbors_.end()), neighbors_.end());
  if (neighbors_.size() < kMinNeighbors) return 0.0;
  normal.normalize();
  std::vector<double> heights;
  for (const Slot neighbor : neighbors_) {
    heights.push_back(normal.dot(scene.PlaceOf(slot) - scene.PlaceOf(neighbor)));
  }
  return std::abs(MedianOf(std::move(heights)));
}

}  // namespace plumb
