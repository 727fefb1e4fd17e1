// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace plumb {

void FaceSupport::ForgetRays() {
  for (const Slot slot : known_slots_) range_of_slot_[slot] = {};
  known_slots_.clear();
  rays_.clear();
}

FaceSupport::RayRange FaceSupport::RangeOf(const RayScene& scene, Slot slot) {
  if (range_of_slot_.size() <= slot) range_of_slot_.resize(slot + 1);
  RayRange& range = range_of_slot_[slot];
  if (range.end != 0) return range;
  scene.RaysOf(slot, &new_rays_);
  range.begin = static_cast<std::uint32_t>(rays_.size());
  rays_.insert(rays_.end(), new_rays_.begin(), new_rays_.end());
  range.end = static_cast<std::uint32_t>(rays_.size());
  if (range.end != 0) known_slots_.push_back(slot);
  return range;
}

bool FaceSupport::IsSupported(const RayScene& scene, const FaceSlots& slots) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = scene.PlaceOf(slots[k]);
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  double nearest_squared = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const RayRange range = RangeOf(scene, slots[k]);
    bool is_seen = false;
    std::size_t num_common = 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const SceneRay& ray = rays_[i];
      const Eigen::Vector3d to_camera = ray.camera - corners[k];
      nearest_squared = std::min(nearest_squared, to_camera.squaredNorm());
      if (!(normal.dot(to_camera) > 0.0)) continue;
      is_seen = true;
      if (k == 0) {
        common_.resize(++num_common);
        common_.back() = ray.photo;
      } else if (std::binary_search(common_.begin(), common_.end(), ray.photo)) {
        common_[num_common++] = ray.photo;  // All before it are less than what is searched for.
      }
    }
    if (!is_seen) return false;
    common_.resize(num_common);
  }
  double longest_squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest_squared = std::max(longest_squared, (corners[k] - corners[(k + 1) % 3]).squaredNorm());
  }
  const double bound = max_edge_ratio_ * max_edge_ratio_ * nearest_squared;
  return longest_squared <= (common_.empty() ? bound : 4.0 * bound);
}

}  // namespace plumb
