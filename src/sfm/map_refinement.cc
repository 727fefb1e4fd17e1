// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/map_refinement.h"

#include <optional>

#include "sfm/expander.h"

namespace plumb {
MapRefinement RefineMap(const RefinementOptions& options,
                        const Camera& camera,
                        const BundleConstraints& constraints,
                        Map* map) {
  ThrowIfProblems("refinement", options.Problems());
  MapRefinement result{false, camera, {}, {}, 0};
  for (int round = 0; round < options.num_rounds; ++round) {
    BundleProblem problem =
        MakeGlobalBundle(options.bundle, *map, result.camera.lens(), constraints);
    const BundleReport report = SolveBundle(options.bundle,
                                            options.bundle.max_global_iterations,
                                            options.bundle.function_tolerance,
                                            nullptr,
                                            &problem);
    // Too few photos may bend the lens out of shape.
    const std::optional<Camera> refined = camera.WithLens(problem.lens);
    if (!report.is_usable || !refined) return result;
    ApplyBundle(problem, map);
    if (refined->lens() != result.camera.lens()) map->SetLens(refined->lens());
    result.camera = *refined;
    if (!result.is_usable) result.first = report;
    result.last = report;
    result.is_usable = true;
    result.num_removed += static_cast<std::size_t>(
        CullLandmarks(options.expander, result.camera, map->LandmarkIds(), map));
  }
  return result;
}

}  // namespace plumb
