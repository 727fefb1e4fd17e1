// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/geometry/similarity3.h"

namespace plumb {

// Camera centres, those of a photo under the same index.
struct Centers {
  std::vector<Eigen::Vector3d> in_map;
  std::vector<Eigen::Vector3d> in_world;
};

// world_from_map that fits all centres best if it leaves none farther than max_error_m; else the
// one of the largest set of centres found to agree within it, if that is more than half; else the
// former. Nothing if the centres lie on a line. Deterministic.
std::optional<Similarity3> AlignCenters(const Centers& centers, double max_error_m);

}  // namespace plumb
