// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct QualityOptions {
  // Noise of a measured pixel coordinate [px] while the bundle has too few residuals to tell it.
  double default_noise_px = 0.5;

  // Threads of one step; 0: one for each core. Does not change the result.
  int num_threads = 0;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(QualityOptions& options, Visitor&& visit) {
  visit("default_noise_px", options.default_noise_px);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
