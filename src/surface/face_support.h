// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "surface/face_pool.h"
#include "surface/ray_scene.h"

namespace plumb {

// Whether rays say that a face between free and occupied is a surface, and not what closes the
// occupied space where nobody looked. It is one if
//   - each corner is seen from the free side of the face's plane, less than 78 degrees off
//     its normal: what closes the space behind a wall has all cameras on its occupied side, and
//     what closes a step in depth all of them in its plane;
//   - its longest edge is at most max_edge_ratio times the distance of the nearest camera of its
//     corners, or at most twice that and one photo shows all three corners from the free side: long
//     faces span what no landmark is on, an open side most of all.
//
// Serves one state of the scene. Rays once asked for are kept for a while: a landmark is a corner
// of some six faces.
class FaceSupport {
 public:
  FaceSupport(const RayScene& scene, double max_edge_ratio)
      : scene_(scene), max_edge_ratio_(max_edge_ratio) {}

  // A function of the corners' places and rays alone.
  bool IsSupported(const FaceSlots& slots);

 private:
  struct Known {
    Slot slot = kNoSlot;
    std::vector<SceneRay> rays;
  };

  const std::vector<SceneRay>& RaysOf(Slot slot);

  const RayScene& scene_;
  double max_edge_ratio_;
  std::array<Known, 64> known_;  // By the last bits of the slot.
  std::vector<PhotoId> common_;  // Photos that show all corners so far, ascending.
};

}  // namespace plumb
