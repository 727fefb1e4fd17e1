// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/surface/surface_options.h"
#include "surface/face_pool.h"
#include "surface/ray_scene.h"

namespace plumb {

// Whether rays say that a face between free and occupied is a surface, and not what closes the
// occupied space where nobody looked. It is one if
//   - each corner is seen from the free side of the face's plane: what closes the space behind a
//     wall has all cameras on its occupied side;
//   - its longest edge is at most max_edge_ratio times the distance of the nearest camera of its
//     corners, or at most twice that and one photo shows all three corners from the free side: long
//     faces span what no landmark is on, an open side most of all.
class FaceSupport {
 public:
  explicit FaceSupport(const SurfaceOptions& options) : max_edge_ratio_(options.max_edge_ratio) {}

  // A function of the corners' places and rays alone.
  bool IsSupported(const RayScene& scene, const FaceSlots& slots);

 private:
  double max_edge_ratio_;
  std::vector<SceneRay> rays_;
  std::vector<PhotoId> common_;  // Photos that show all corners so far, ascending.
};

}  // namespace plumb
