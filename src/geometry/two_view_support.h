// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "geometry/epipolar.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {

struct TwoViewSupport {
  std::vector<char> is_inlier;  // Per match.
  int num_inliers = 0;
  double cost = 0.0;  // Sum of min(error^2 / max_error^2, 1), error the greater of both views'.
};

// Which matches a point explains that lies in front of both cameras, or at infinity, and
// reprojects within `max_error` in each.
TwoViewSupport SupportOf(const Rigid3& cam2_from_cam1,
                         const std::vector<NormalizedMatch>& matches,
                         double max_error);

// Median angle between the two rays of the inliers [rad]; 0 without any.
double MedianParallax(const Rigid3& cam2_from_cam1,
                      const std::vector<NormalizedMatch>& matches,
                      const std::vector<char>& is_inlier);

}  // namespace plumb
