// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/feature_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> FeatureOptions::Problems() const {
  ProblemList problems;
  problems.Require(max_features >= 1, "max_features", "at least 1", max_features);
  problems.Require(min_features >= 0, "min_features", "at least 0", min_features);
  problems.Require(
      min_features <= max_features, "min_features", "at most max_features", min_features);
  problems.Require(min_contrast > 0.0 && min_contrast < 1.0,
                   "min_contrast",
                   "greater than 0 and less than 1",
                   min_contrast);
  problems.Require(max_edge_ratio >= 1.0, "max_edge_ratio", "at least 1", max_edge_ratio);
  problems.Require(
      pixels_per_feature > 0.0, "pixels_per_feature", "greater than 0", pixels_per_feature);
  problems.Require(
      min_fill >= 0.0 && min_fill <= 1.0, "min_fill", "at least 0 and at most 1", min_fill);
  problems.Require(max_octave_megapixels > 0.0,
                   "max_octave_megapixels",
                   "greater than 0",
                   max_octave_megapixels);
  problems.Require(max_blur > 0.0, "max_blur", "greater than 0", max_blur);
  problems.Require(num_threads >= 0, "num_threads", "at least 0", num_threads);
  return problems.Take();
}

}  // namespace plumb
