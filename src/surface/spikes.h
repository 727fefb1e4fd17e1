// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "surface/face_pool.h"
#include "surface/ray_scene.h"

namespace plumb {

// Tells spikes: landmarks that only two photos show and that stand out of their neighbours by more
// than `max_spike_ratio` times the distance of the nearest camera. Two rays always meet somewhere
// along the epipolar line, also those of a wrong match; a step in depth is believed when a third
// photo shows it. The cost grows with the change, not with the mesh.
class SpikeFinder {
 public:
  explicit SpikeFinder(double max_spike_ratio) : max_spike_ratio_(max_spike_ratio) {}

  // Brings the marks up to date after faces of `pool` around `slots` came, went or changed, or the
  // place or the rays of one of their corners. Gives the faces around slots whose mark changed.
  std::vector<FaceIdx> Update(std::vector<Slot> slots, const RayScene& scene, const FacePool& pool);

  bool IsSpike(Slot slot) const { return slot < is_spike_.size() && is_spike_[slot] != 0; }
  bool HasSpike(const FaceSlots& slots) const {
    return std::any_of(slots.begin(), slots.end(), [&](Slot slot) { return IsSpike(slot); });
  }

 private:
  bool StandsOut(Slot slot, const RayScene& scene, const FacePool& pool);
  double HeightOf(Slot slot, const RayScene& scene, const FacePool& pool);

  double max_spike_ratio_;
  std::vector<char> is_spike_;  // By slot.
  std::vector<SceneRay> rays_;  // Of the landmark at hand, as are the rest.
  std::vector<FaceIdx> ring_;
  std::vector<Slot> neighbors_;
};

}  // namespace plumb
