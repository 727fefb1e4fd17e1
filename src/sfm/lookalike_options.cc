// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/lookalike_options.h"

namespace plumb {

std::vector<std::string> LookalikeOptions::Problems() const {
  ProblemList list;
  list.Require(min_common_share > 0.0 && min_common_share <= 1.0,
               "min_common_share",
               "in (0, 1]",
               min_common_share);
  list.Require(max_found_share > 0.0 && max_found_share <= 1.0,
               "max_found_share",
               "in (0, 1]",
               max_found_share);
  list.Require(max_unsupported_share > 0.0 && max_unsupported_share <= max_found_share,
               "max_unsupported_share",
               "greater than 0 and at most max_found_share",
               max_unsupported_share);
  list.Require(min_neighbor_share >= 0.0 && min_neighbor_share <= 1.0,
               "min_neighbor_share",
               "in [0, 1]",
               min_neighbor_share);
  list.Require(max_samples >= 4, "max_samples", "at least 4", max_samples);
  list.Require(max_iterations >= 1, "max_iterations", "at least 1", max_iterations);
  return list.Take();
}

}  // namespace plumb
