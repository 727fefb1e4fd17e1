// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bootstrap_options.h"

namespace plumb {

std::vector<std::string> BootstrapOptions::Problems() const {
  ProblemList list;
  list.Require(max_error_px > 0.0, "max_error_px", "greater than 0", max_error_px);
  list.Require(min_num_inliers >= 15, "min_num_inliers", "at least 15", min_num_inliers);
  list.Require(min_parallax_deg > 0.0, "min_parallax_deg", "greater than 0", min_parallax_deg);
  list.Require(good_parallax_deg >= min_parallax_deg,
               "good_parallax_deg",
               "at least min_parallax_deg",
               good_parallax_deg);
  list.Require(min_score_gain > 1.0, "min_score_gain", "greater than 1", min_score_gain);
  list.Require(max_young_views >= 2, "max_young_views", "at least 2", max_young_views);
  list.Require(max_partners >= 1, "max_partners", "at least 1", max_partners);
  list.Require(max_iterations >= 1, "max_iterations", "at least 1", max_iterations);
  return list.Take();
}

}  // namespace plumb
