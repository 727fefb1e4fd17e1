// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "plumbline/surface/surface_options.h"
#include "surface/face_pool.h"
#include "surface/ray_scene.h"

namespace plumb {

// What rays say for a face between free and occupied.
struct FaceEvidence {
  std::array<int, 3> num_outside = {0, 0, 0};  // Rays of each corner from the free side.
  int num_common = 0;                          // Photos that see all three corners from there.
  double max_sine = 0.0;                       // Between the face and the steepest ray from there.
  double max_common_sine = 0.0;
  double longest_edge = 0.0;  // Over the distance of the nearest camera of its ends.
};

// Whether rays say that a face between free and occupied is a surface, and not what closes the
// occupied space where nobody looked.
class FaceSupport {
 public:
  explicit FaceSupport(const SurfaceOptions& options) : options_(options) {}

  // A function of the corners' places and rays alone.
  FaceEvidence EvidenceOf(const RayScene& scene, const FaceSlots& slots);
  bool IsSupported(const RayScene& scene, const FaceSlots& slots);

 private:
  SurfaceOptions options_;
  std::array<std::vector<SceneRay>, 3> rays_;
};

}  // namespace plumb
