// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/map/photo_verdict.h"
#include "plumbline/matching/descriptor_matcher.h"
#include "plumbline/sfm/bootstrap_options.h"
#include "sfm/photo_record.h"

namespace plumb {

// Two photos that a map can start from.
struct InitialPair {
  PhotoId photo1;
  PhotoId photo2;
  Rigid3 cam2_from_cam1;  // Scaled to a median depth of kInitialMedianDepth in the first photo.
  int num_inliers = 0;
  double parallax_deg = 0.0;  // Median.
  double score = 0.0;         // Inliers, less where parallax falls short of good_parallax_deg.
};

// Lengths of a map without scale are in units of a tenth of its first median depth.
constexpr double kInitialMedianDepth = 10.0;

struct PairAttempt {
  std::optional<InitialPair> pair;
  RefusalReason reason = RefusalReason::kNone;  // If there is no pair.
};

// Estimates the two-view geometry of two photos and judges whether a map can start
// from it. idx1 of the matches belongs to `photo1`. Thread-safe.
PairAttempt TryInitialPair(const BootstrapOptions& options,
                           const Camera& camera,
                           const PhotoRecord& photo1,
                           const PhotoRecord& photo2,
                           const std::vector<FeatureMatch>& matches);

// Pose of the first camera of a map: its optical axis lies along the map's y and its x along the
// map's x, so that the map's z is up as long as the photo was taken upright.
Rigid3 FirstCameraFromMap();

}  // namespace plumb
