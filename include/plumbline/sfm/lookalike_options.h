// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

// Repeated windows: is there a second place where a photo would look the same?
struct LookalikeOptions {
  // A second place must have this share of the photo's landmarks in view: there they can be
  // compared.
  double min_common_share = 0.15;

  // Of those in view, features that look like this share of them make the photo ambiguous. On
  // south_building at most 0.09 do, on a facade of copies 0.3 to 0.8.
  double max_found_share = 0.25;

  // From this share on the windows repeat, and the photo is believed only beside the one taken
  // before or after it: three bays further on there may be such a door again.
  double max_unsupported_share = 0.08;

  // A photo is beside another if that one sees this share of its landmarks.
  double min_neighbor_share = 0.25;

  // At most so many of the photo's landmarks are looked for elsewhere in it.
  int max_samples = 300;

  // RANSAC tries at most this many samples for each place.
  int max_iterations = 1000;

  // Seed of RANSAC: equal input and seed give equal places.
  int random_seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(LookalikeOptions& options, Visitor&& visit) {
  visit("min_common_share", options.min_common_share);
  visit("max_found_share", options.max_found_share);
  visit("max_unsupported_share", options.max_unsupported_share);
  visit("min_neighbor_share", options.min_neighbor_share);
  visit("max_samples", options.max_samples);
  visit("max_iterations", options.max_iterations);
  visit("random_seed", options.random_seed);
}

}  // namespace plumb
