// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

struct ExpanderOptions {
  // Bound on the distance of a match from its epipolar line (Sampson) [px].
  double max_epipolar_error_px = 4.0;

  // Bound on the reprojection error of every observation [px].
  double max_error_px = 4.0;

  // Smallest angle between two rays of a landmark; below it the depth is noise.
  double min_parallax_deg = 1.5;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(ExpanderOptions& options, Visitor&& visit) {
  visit("max_epipolar_error_px", options.max_epipolar_error_px);
  visit("max_error_px", options.max_error_px);
  visit("min_parallax_deg", options.min_parallax_deg);
}

}  // namespace plumb
