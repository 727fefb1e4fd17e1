// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/common/ids.h"

namespace plumb {

class Camera;
class Map;

// A position measured by other means, brought into the map.
struct MeasuredPosition {
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  double sigma = 0.0;  // Standard deviation of each coordinate [map units]; greater than 0.
};

struct MarkerSighting {
  PhotoId photo;
  Eigen::Vector2d center_px;  // Raw pixel.
  double sigma_px = 0.0;      // Standard deviation of each coordinate; greater than 0.
};

// A coded marker: a point with a known identity.
struct MarkerTrack {
  int marker_id = -1;
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();  // As triangulated so far.
  std::optional<MeasuredPosition> survey;                     // If it is a control point.
  std::vector<MarkerSighting> sightings;
};

// Where the camera was, by the MAV's navigation.
struct CenterPrior {
  PhotoId photo;
  MeasuredPosition center;
};

// What ties a global bundle to more than the photos' features. Views that the map does not hold
// are passed over.
struct BundleConstraints {
  std::vector<MarkerTrack> markers;
  std::vector<CenterPrior> centers;
};

// The same for the map as it is now: each marker is triangulated anew from the views that show it,
// and what was measured goes along with the similarity that takes the markers from where they were
// to where they are. Where three markers do not tell it, their surveys and the centres are left
// out: they may lie anywhere in the map.
BundleConstraints MovedWithMap(const BundleConstraints& constraints,
                               const Camera& camera,
                               const Map& map);

}  // namespace plumb
