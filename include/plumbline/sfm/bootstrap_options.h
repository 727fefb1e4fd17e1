// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

struct BootstrapOptions {
  // Bound on the error of a match against the two-view geometry [px].
  double max_error_px = 4.0;

  // A pair with fewer points in front of both cameras is not trusted with the map's start.
  int min_num_inliers = 80;

  // Median angle between the two rays of a point: below it depths are noise.
  double min_parallax_deg = 2.0;

  // A pair with this much parallax is good enough to stop looking for a better one.
  double good_parallax_deg = 6.0;

  // A young map is started again from a pair whose score is this many times better.
  double min_score_gain = 1.5;

  // A map with more views than this is no longer young.
  int max_young_views = 4;

  // Each new photo is paired with at most this many earlier ones.
  int max_partners = 8;

  // RANSAC tries at most this many samples for each pair.
  int max_iterations = 2000;

  // Seed of RANSAC: equal input and seed give equal pairs.
  int random_seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(BootstrapOptions& options, Visitor&& visit) {
  visit("max_error_px", options.max_error_px);
  visit("min_num_inliers", options.min_num_inliers);
  visit("min_parallax_deg", options.min_parallax_deg);
  visit("good_parallax_deg", options.good_parallax_deg);
  visit("min_score_gain", options.min_score_gain);
  visit("max_young_views", options.max_young_views);
  visit("max_partners", options.max_partners);
  visit("max_iterations", options.max_iterations);
  visit("random_seed", options.random_seed);
}

}  // namespace plumb
