// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/common/ids.h"
#include "plumbline/map/map.h"

namespace plumb {

struct CovisibleView {
  PhotoId photo;
  int num_shared = 0;  // Landmarks seen in both.
};

// The views that share landmarks with `photo`, most shared first, ties by id.
std::vector<CovisibleView> CovisibleViews(const Map& map, PhotoId photo);

// At most `max_landmarks` of those seen in any of `photos`, longest tracks first, in the
// order of ids.
std::vector<LandmarkId> LongestTracks(const Map& map,
                                      const std::vector<PhotoId>& photos,
                                      int max_landmarks);

}  // namespace plumb
