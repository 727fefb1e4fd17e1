// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_options.h"

namespace plumb::tools {

MapperOptions ExperimentOptions::LensRefined() {
  MapperOptions mapper;
  mapper.bundle.refine_focal_length = true;
  mapper.bundle.refine_principal_point = true;
  mapper.bundle.refine_distortion = true;
  return mapper;
}

std::vector<std::string> ExperimentOptions::Problems() const {
  ProblemList list;
  list.Append("reconstruction", reconstruction.Problems());
  list.Append("refinement", refinement.Problems());
  list.Require(distance_exponent > 0.0 && distance_exponent <= 4.0,
               "distance_exponent",
               "greater than 0, at most 4",
               distance_exponent);
  list.Append("georeferencer", georeferencer.Problems());
  return list.Take();
}

}  // namespace plumb::tools
