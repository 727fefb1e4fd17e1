// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "geometry/epipolar.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {

// (xy2, 1) ~ H (xy1, 1) through four matches; nothing if three lie on a line or the plane is
// seen from both sides.
std::optional<Eigen::Matrix3d> SolveHomography(const std::array<NormalizedMatch, 4>& matches);

// Least squares of the transfer error in view 2, reweighted, from `initial`.
Eigen::Matrix3d RefineHomography(const Eigen::Matrix3d& initial,
                                 const std::vector<NormalizedMatch>& matches);

// The poses cam2_from_cam1, |translation| = 1, that a plane seen in both views through `h` allows;
// for a pure rotation one pose with an arbitrary translation.
std::vector<Rigid3> PosesFromHomography(const Eigen::Matrix3d& h);

}  // namespace plumb
