// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/expander_options.h"

namespace plumb {

std::vector<std::string> ExpanderOptions::Problems() const {
  ProblemList list;
  list.Require(max_epipolar_error_px > 0.0,
               "max_epipolar_error_px",
               "greater than 0",
               max_epipolar_error_px);
  list.Require(max_error_px > 0.0, "max_error_px", "greater than 0", max_error_px);
  list.Require(min_parallax_deg > 0.0, "min_parallax_deg", "greater than 0", min_parallax_deg);
  return list.Take();
}

}  // namespace plumb
