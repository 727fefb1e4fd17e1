// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/covisibility.h"

#include <algorithm>
#include <map>

namespace plumb {

std::vector<CovisibleView> CovisibleViews(const Map& map, PhotoId photo) {
  std::map<PhotoId, int> num_shared;
  for (const LandmarkId id : map.view(photo).landmark_of_feature) {
    if (!id.IsValid()) continue;
    for (const Observation& observation : map.landmark(id).track) {
      if (observation.photo != photo) ++num_shared[observation.photo];
    }
  }
  std::vector<CovisibleView> views;
  for (const auto& [other, count] : num_shared) views.push_back({other, count});
  std::stable_sort(views.begin(), views.end(), [](const CovisibleView& a, const CovisibleView& b) {
    return a.num_shared > b.num_shared;
  });
  return views;
}

std::vector<LandmarkId> LongestTracks(const Map& map,
                                      const std::vector<PhotoId>& photos,
                                      int max_landmarks) {
  std::vector<LandmarkId> ids;
  for (const PhotoId photo : photos) {
    for (const LandmarkId id : map.view(photo).landmark_of_feature) {
      if (id.IsValid()) ids.push_back(id);
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.size() <= static_cast<std::size_t>(max_landmarks)) return ids;
  std::stable_sort(ids.begin(), ids.end(), [&](LandmarkId a, LandmarkId b) {
    return map.landmark(a).track.size() > map.landmark(b).track.size();
  });
  ids.resize(static_cast<std::size_t>(max_landmarks));
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace plumb
