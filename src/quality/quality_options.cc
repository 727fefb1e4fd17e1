// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/quality_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> QualityOptions::Problems() const {
  ProblemList problems;
  problems.Require(default_noise_px > 0.0 && default_noise_px <= 100.0,
                   "default_noise_px",
                   "above 0 and at most 100",
                   default_noise_px);
  problems.Require(num_threads >= 0, "num_threads", "0 or more", num_threads);
  return problems.Take();
}

}  // namespace plumb
