// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map.h"
#include "plumbline/sfm/bundle_constraints.h"
#include "plumbline/sfm/bundle_problem.h"
#include "plumbline/sfm/refinement_options.h"

namespace plumb {

struct MapRefinement {
  bool is_usable = false;  // Otherwise the map is as it was.
  Camera camera;           // With the refined lens, if it is refined.
  BundleReport first;
  BundleReport last;
  std::size_t num_removed = 0;  // Observations.
};

// The last bundle of a map that is complete, with its control points and, where the options say so,
// the lens of all photos. What then does not fit is removed, and so on in turns. `camera` holds the
// lens that the map was made with. Constraints are in the map as it is. Deterministic.
//
// Throws std::invalid_argument if options.Problems() is not empty.
MapRefinement RefineMap(const RefinementOptions& options,
                        const Camera& camera,
                        const BundleConstraints& constraints,
                        Map* map);

}  // namespace plumb
