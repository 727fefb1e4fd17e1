// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

  // A function of the corners' places and rays alone. Rays once asked for are kept: a landmark is a
  // corner of some six faces.
  bool IsSupported(const RayScene& scene, const FaceSlots& slots);

  // To be called before the scene changes.
  void ForgetRays();

 private:
  struct RayRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;  // 0: not known.
  };

  RayRange RangeOf(const RayScene& scene, Slot slot);

  double max_edge_ratio_;
  std::vector<SceneRay> rays_;  // Of known landmarks, one after the other.
  std::vector<RayRange> range_of_slot_;
  std::vector<Slot> known_slots_;
  std::vector<SceneRay> new_rays_;
  std::vector<PhotoId> common_;  // Photos that show all corners so far, ascending.
};

}  // namespace plumb
