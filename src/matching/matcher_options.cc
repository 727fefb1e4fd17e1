// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/matcher_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> MatcherOptions::Problems() const {
  ProblemList problems;
  problems.Require(max_ratio > 0.0 && max_ratio <= 1.0, "max_ratio", "in (0, 1]", max_ratio);
  problems.Require(
      max_wide_ratio > 0.0 && max_wide_ratio <= 1.0, "max_wide_ratio", "in (0, 1]", max_wide_ratio);
  problems.Require(num_threads >= 1, "num_threads", "at least 1", num_threads);
  return problems.Take();
}

}  // namespace plumb
