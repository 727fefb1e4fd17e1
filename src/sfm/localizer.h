// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map.h"
#include "plumbline/sfm/localizer_options.h"
#include "sfm/photo_record.h"

namespace plumb {

// A feature of a photo that may show a landmark.
struct MapMatch {
  std::uint32_t feature_idx = 0;
  LandmarkId landmark;
};

struct Localization {
  enum class Status { kOk, kTooFewMatches, kTooFewInliers, kAmbiguous };

  Status status = Status::kTooFewMatches;
  Rigid3 cam_from_map;  // Meaningful only if kOk.
  int num_matches = 0;
  std::vector<MapMatch> inliers;  // One-to-one; of the best pose found, also if refused.
  double median_error_px = 0.0;   // Of the inliers.
};

// Estimates the pose of a photo: P3P in a locally optimised RANSAC, a search for a
// second place that fits as well, then refinement of the reprojection error. Matches may
// contradict each other. Deterministic. Thread-safe.
Localization LocalizePhoto(const LocalizerOptions& options,
                           const Camera& camera,
                           const Map& map,
                           const PhotoRecord& photo,
                           const std::vector<MapMatch>& matches);

// Refines the pose on the matches within `max_error_px` of it, and sets the inliers to those
// within options.max_refined_error_px of the refined pose.
void RefineOnMatches(const LocalizerOptions& options,
                     const Camera& camera,
                     const Map& map,
                     const PhotoRecord& photo,
                     const std::vector<MapMatch>& matches,
                     double max_error_px,
                     Localization* localization);

// Looks for the landmarks seen in `views` where a located photo must show them, and
// refines the pose with all. `localization` must be kOk; its inliers grow.
void ExtendByGuidedMatching(const LocalizerOptions& options,
                            const Camera& camera,
                            const Map& map,
                            const PhotoRecord& photo,
                            const std::vector<PhotoId>& views,
                            Localization* localization);

}  // namespace plumb
