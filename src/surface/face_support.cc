// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace plumb {

const std::vector<SceneRay>& FaceSupport::RaysOf(Slot slot) {
  Known& known = known_[slot % known_.size()];
  if (known.slot != slot) {
    known.slot = slot;
    scene_.RaysOf(slot, &known.rays);
  }
  return known.rays;
}

bool FaceSupport::IsSupported(const FaceSlots& slots) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = scene_.PlaceOf(slots[k]);
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  double nearest_squared = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    bool is_seen = false;
    std::size_t num_common = 0;
    for (const SceneRay& ray : RaysOf(slots[k])) {
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
