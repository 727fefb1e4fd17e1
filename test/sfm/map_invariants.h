// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "plumbline/map/map.h"

namespace plumb::test {

// What of the map contradicts itself; empty if nothing does.
inline std::string ContradictionIn(const Map& map) {
  std::size_t num_observations = 0;
  std::map<PhotoId, int> num_by_view;
  for (const LandmarkId id : map.LandmarkIds()) {
    const std::string name = "landmark " + std::to_string(id.value);
    const std::vector<Observation>& track = map.landmark(id).track;
    if (track.size() < 2) return name + " has fewer than two observations";
    std::set<PhotoId> photos;
    for (const Observation& observation : track) {
      if (!map.HasView(observation.photo)) return name + " is seen in no view";
      if (map.LandmarkOf(observation) != id) return name + " is not its feature's";
      if (!photos.insert(observation.photo).second) return name + " is seen twice in one view";
      ++num_by_view[observation.photo];
      ++num_observations;
    }
  }
  if (num_observations != map.num_observations()) return "the observations are miscounted";
  for (const auto& [photo, view] : map.views()) {
    if (view.num_observations != num_by_view[photo]) return view.name + " is miscounted";
    for (const LandmarkId id : view.landmark_of_feature) {
      if (id.IsValid() && !map.HasLandmark(id)) return view.name + " shows a landmark that is gone";
    }
  }
  return "";
}

}  // namespace plumb::test
