// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/georeference/georeferencer_options.h"
#include "plumbline/sfm/mapper_options.h"
#include "plumbline/sfm/refinement_options.h"

namespace plumb::tools {

struct ExperimentOptions {
  // As in flight, but that the lens is refined while the map grows.
  MapperOptions reconstruction = LensRefined();

  // Of the last bundles; their lens and distance term follow from the kind of bundle.
  RefinementOptions refinement;

  // bundle.distance_exponent of the multi-scale bundles.
  double distance_exponent = 1.0;

  GeoreferencerOptions georeferencer;

  std::vector<std::string> Problems() const;

 private:
  static MapperOptions LensRefined();
};

template <typename Visitor>
void VisitFields(ExperimentOptions& options, Visitor&& visit) {
  visit("reconstruction", options.reconstruction);
  visit("refinement", options.refinement);
  visit("distance_exponent", options.distance_exponent);
  visit("georeferencer", options.georeferencer);
}

}  // namespace plumb::tools
