// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/refinement_options.h"

namespace plumb {

// The lens of all photos together is known better from a whole map than from any calibration. The
// bend of a wall changes the cost by less than a thousandth: the tolerance must be finer.
BundleOptions RefinementOptions::RefiningBundle() {
  BundleOptions bundle;
  bundle.refine_focal_length = true;
  bundle.refine_principal_point = true;
  bundle.refine_distortion = true;
  bundle.initial_trust_radius = 1e12;
  bundle.max_global_iterations = 40;
  bundle.function_tolerance = 1e-6;
  return bundle;
}

std::vector<std::string> RefinementOptions::Problems() const {
  ProblemList list;
  list.Append("bundle", bundle.Problems());
  list.Append("expander", expander.Problems());
  list.Require(num_rounds >= 1, "num_rounds", "at least 1", num_rounds);
  return list.Take();
}

}  // namespace plumb
