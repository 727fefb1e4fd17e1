// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/camera/projection.h"
#include "plumbline/common/ids.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/image/features.h"

namespace plumb {

struct ViewState {
  PhotoId photo;
  std::string name;  // File name of the photo, without a folder.
  Timestamp exposure_time;
  Rigid3 cam_from_map;
};

struct LandmarkState {
  LandmarkId id;
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  Rgb color = {0, 0, 0};
};

struct ObservationState {
  LandmarkId landmark;
  PhotoId photo;
  std::uint32_t feature_idx = 0;
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // Raw pixel.
};

// All that changed in the map between two moments; the only way a change
// leaves the map. Deltas are numbered from 1 without gaps; applying them in order to an
// empty map gives the map. A snapshot is a delta that starts from the empty map.
// Apply removals first: observations, landmarks, views; then views, landmarks, observations set.
struct MapDelta {
  std::uint32_t sequence = 0;
  bool is_snapshot = false;  // Replaces everything known before.

  std::optional<LensParameters<double>> lens;  // If the shared lens was refined.

  std::vector<ObservationState> observations_removed;
  std::vector<LandmarkId> landmarks_removed;  // With all their observations.
  std::vector<PhotoId> views_removed;         // With all their observations.

  std::vector<ViewState> views_set;          // Added or moved.
  std::vector<LandmarkState> landmarks_set;  // Added or moved.
  std::vector<ObservationState> observations_added;
};

}  // namespace plumb
