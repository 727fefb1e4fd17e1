// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/options.h"
#include "plumbline/quality/gaps.h"

namespace plumb {

std::vector<std::string> GapOptions::Problems() const {
  ProblemList problems;
  problems.Require(min_views >= 2, "min_views", "at least 2", min_views);
  problems.Require(wanted_gsd_mm > 0.0 && wanted_gsd_mm <= 1000.0,
                   "wanted_gsd_mm",
                   "above 0 and at most 1000",
                   wanted_gsd_mm);
  problems.Require(wanted_relative_gsd > 0.0 && wanted_relative_gsd <= 100.0,
                   "wanted_relative_gsd",
                   "above 0 and at most 100",
                   wanted_relative_gsd);
  problems.Require(min_distance_m >= 0.0 && min_distance_m <= 1000.0,
                   "min_distance_m",
                   "0 to 1000",
                   min_distance_m);
  problems.Require(min_relative_distance >= 0.0 && min_relative_distance <= 1.0,
                   "min_relative_distance",
                   "0 to 1",
                   min_relative_distance);
  problems.Require(min_area_share > 0.0 && min_area_share <= 100.0,
                   "min_area_share",
                   "above 0 and at most 100",
                   min_area_share);
  problems.Require(min_share_of_largest >= 0.0 && min_share_of_largest <= 1.0,
                   "min_share_of_largest",
                   "0 to 1",
                   min_share_of_largest);
  problems.Require(max_gaps >= 0, "max_gaps", "not negative", max_gaps);
  return problems.Take();
}

}  // namespace plumb
