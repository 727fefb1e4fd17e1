// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_delta.h"
#include "plumbline/quality/quality_block.h"
#include "plumbline/quality/quality_options.h"
#include "plumbline/surface/mesh_delta.h"

namespace plumb {

// What one step did.
struct QualityUpdate {
  // Those whose mesh or quality is another than before, ascending; one that is no longer in
  // blocks() is gone.
  std::vector<BlockId> blocks;
  bool is_noise_changed = false;  // Then the predicted accuracy of every face is.

  std::size_t num_rays = 0;  // Pairs of face and view, in frame and facing, that were looked at.
  double seconds = 0.0;      // Wall clock.
};

// Keeps the quality of each face of a growing mesh. Only pairs of face and camera are looked at of
// which one changed, or that have a changed face in between. The outcome is a function of map and
// mesh alone, not of the way they came about. Not thread-safe.
class QualityMap {
 public:
  // Throws std::invalid_argument if options.Problems() is not empty.
  explicit QualityMap(const QualityOptions& options);
  ~QualityMap();
  QualityMap(const QualityMap&) = delete;
  QualityMap& operator=(const QualityMap&) = delete;

  // The camera of all views, until a delta brings a refined lens; before it is known, no face is
  // seen.
  QualityUpdate SetCamera(const Camera& camera);

  // A step of the map and what it made of the mesh. The caller sees to it that none is missing;
  // snapshots replace all. Nothing that a delta holds throws: views that are not finite, or a lens
  // that Camera refuses, are left out.
  QualityUpdate Apply(const MapDelta& map_delta, const MeshDelta& mesh_delta);

  const std::map<BlockId, QualityBlock>& blocks() const;

  // Those that are usable, by photo.
  const std::map<PhotoId, Rigid3>& views() const;
  const std::optional<Camera>& camera() const;

  // Standard deviation of a measured pixel coordinate, from the residuals of the bundle, in steps
  // of a tenth.
  double noise_px() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
