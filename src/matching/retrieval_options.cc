// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/retrieval_options.h"

#include "plumbline/common/options.h"

namespace plumb {

std::vector<std::string> RetrievalOptions::Problems() const {
  ProblemList problems;
  problems.Require(branching >= 2 && branching <= 100, "branching", "in [2, 100]", branching);
  problems.Require(depth >= 1 && depth <= 8, "depth", "in [1, 8]", depth);
  problems.Require(num_iterations >= 1, "num_iterations", "at least 1", num_iterations);
  problems.Require(
      num_training_photos >= 1, "num_training_photos", "at least 1", num_training_photos);
  problems.Require(max_training_descriptors >= 1,
                   "max_training_descriptors",
                   "at least 1",
                   max_training_descriptors);
  problems.Require(
      num_compared_features >= 1, "num_compared_features", "at least 1", num_compared_features);
  problems.Require(num_photos_until_trained >= 0,
                   "num_photos_until_trained",
                   "at least 0",
                   num_photos_until_trained);
  return problems.Take();
}

}  // namespace plumb
