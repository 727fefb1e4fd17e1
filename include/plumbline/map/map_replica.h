// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "plumbline/map/map_delta.h"

namespace plumb {

// The map as its deltas tell it, for whoever stands downstream of the mapper: positions and
// tracks, no features. Not thread-safe.
class MapReplica {
 public:
  struct TrackedLandmark {
    LandmarkState state;
    std::map<std::pair<PhotoId, std::uint32_t>, Eigen::Vector2f> pixel_of_feature;
  };

  // False, and nothing changed, if the delta is no snapshot and not the next in number: ask
  // for a snapshot. Changes of things the replica does not hold are ignored.
  bool Apply(const MapDelta& delta);

  // The whole as one delta, under the number of the last one applied; ascending ids.
  MapDelta Snapshot() const;

  std::uint32_t sequence() const { return sequence_; }
  const std::map<PhotoId, ViewState>& views() const { return views_; }
  const std::unordered_map<LandmarkId, TrackedLandmark>& landmarks() const { return landmarks_; }

 private:
  void Clear();
  void Remove(const MapDelta& delta);
  void Set(const MapDelta& delta);

  std::uint32_t sequence_ = 0;
  std::optional<LensParameters<double>> lens_;
  std::map<PhotoId, ViewState> views_;
  std::unordered_map<LandmarkId, TrackedLandmark> landmarks_;
};

}  // namespace plumb
