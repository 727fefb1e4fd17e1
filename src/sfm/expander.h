// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map.h"
#include "plumbline/sfm/expander_options.h"
#include "sfm/match_graph.h"
#include "sfm/photo_record.h"

namespace plumb {

struct ExpansionReport {
  int num_new_landmarks = 0;
  int num_new_observations = 0;  // Of landmarks there were before.
  int num_merged = 0;
};

// Adds to the map what a newly located view shows: matches pass the epipolar test, continue
// or join tracks, and those of free features are triangulated over all views that match.
ExpansionReport ExpandMap(const ExpanderOptions& options,
                          const Camera& camera,
                          const MatchGraph& matches,
                          const PhotoRecords& photos,
                          PhotoId photo,
                          Map* map);

// Adds to the landmarks the matched features that turn out to fit, and joins landmarks that
// turn out to be one.
ExpansionReport CompleteTracks(const ExpanderOptions& options,
                               const Camera& camera,
                               const MatchGraph& matches,
                               const std::vector<LandmarkId>& landmarks,
                               Map* map);

// Removes observations whose error exceeds the bound or that lie behind the camera, and
// landmarks without enough parallax. Gives the number of observations removed.
int CullLandmarks(const ExpanderOptions& options,
                  const Camera& camera,
                  const std::vector<LandmarkId>& landmarks,
                  Map* map);

}  // namespace plumb
