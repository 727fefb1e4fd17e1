// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_delta.h"

namespace plumb::internal {

// Tells the noise of the measured pixels from the residuals of a share of the landmarks, chosen by
// their ids.
class BundleNoise {
 public:
  void Apply(const MapDelta& delta);

  // Standard deviation of a pixel coordinate; nothing if there are too few residuals.
  std::optional<double> Estimate(const Camera& camera,
                                 const std::map<PhotoId, Rigid3>& cam_from_map) const;

 private:
  struct Track {
    Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
    std::map<std::pair<PhotoId, std::uint32_t>, Eigen::Vector2f> pixel_of_feature;
  };

  void Remove(const MapDelta& delta);

  std::unordered_map<LandmarkId, Track> tracks_;
};

}  // namespace plumb::internal
