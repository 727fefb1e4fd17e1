// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "plumbline/georeference/robust_similarity.h"

namespace plumb {

// Points that fit clearly better as their mirror image: an axis of one side counts the wrong way
// round, or two are exchanged. No turn undoes that, but of points near a plane one comes close.
struct MirrorImage {
  int num_pairs = 0;            // That agree on the mirror image.
  double rms_m = 0.0;           // Of their distances as they stand,
  double mirrored_rms_m = 0.0;  // and as the mirror image.
};

// Whether `pairs`, of which EstimateRobustSimilarity made `as_they_stand`, are one.
std::optional<MirrorImage> FindMirrorImage(const RobustSimilarityOptions& options,
                                           const std::vector<PointPair>& pairs,
                                           const RobustSimilarity& as_they_stand);

}  // namespace plumb
