// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/geometry/similarity3.h"

namespace plumb {

// target_from_source that minimises the sum of squared distances of corresponding points
// (Umeyama, TPAMI 13(4), 1991). Nothing for fewer than three points or if the points of either
// side lie on a line (to 1e-6 of their extent): the rotation about it would be free.
// Precondition: equal lengths.
std::optional<Similarity3> AlignPoints(const std::vector<Eigen::Vector3d>& points_in_source,
                                       const std::vector<Eigen::Vector3d>& points_in_target);

// Distances |target_from_source * source - target|, in the target's unit.
std::vector<double> AlignmentResiduals(const Similarity3& target_from_source,
                                       const std::vector<Eigen::Vector3d>& points_in_source,
                                       const std::vector<Eigen::Vector3d>& points_in_target);

}  // namespace plumb
