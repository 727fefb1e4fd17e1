// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace plumb {

FaceEvidence FaceSupport::EvidenceOf(const RayScene& scene, const FaceSlots& slots) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = scene.PlaceOf(slots[k]);
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  FaceEvidence evidence;
  double nearest = std::numeric_limits<double>::infinity();
  std::array<std::vector<PhotoId>, 3> outside;
  for (std::size_t k = 0; k < 3; ++k) {
    scene.RaysOf(slots[k], &rays_[k]);
    for (const SceneRay& ray : rays_[k]) {
      const Eigen::Vector3d direction = ray.camera - corners[k];
      const double distance = direction.norm();
      nearest = std::min(nearest, distance);
      const double sine = normal.dot(direction) / distance;
      if (!(sine > 0.0)) continue;
      ++evidence.num_outside[k];
      evidence.max_sine = std::max(evidence.max_sine, sine);
      outside[k].push_back(ray.photo);
      if (k < 2) continue;
      const auto sees = [&](std::size_t i) {
        return std::binary_search(outside[i].begin(), outside[i].end(), ray.photo);
      };
      if (!sees(0) || !sees(1)) continue;
      ++evidence.num_common;
      evidence.max_common_sine = std::max(evidence.max_common_sine, sine);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    evidence.longest_edge =
        std::max(evidence.longest_edge, (corners[k] - corners[(k + 1) % 3]).norm() / nearest);
  }
  return evidence;
}

bool FaceSupport::IsSupported(const RayScene& scene, const FaceSlots& slots) {
  const FaceEvidence evidence = EvidenceOf(scene, slots);
  return std::all_of(
      evidence.num_outside.begin(), evidence.num_outside.end(), [](int num) { return num > 0; });
}

}  // namespace plumb
