// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace plumb {

// Essential matrices of unit norm, at most ten, that fit five matches of normalised
// observations: (xy2, 1)^T E (xy1, 1) = 0.
std::vector<Eigen::Matrix3d> SolveFivePoint(const std::array<Eigen::Vector2d, 5>& xy1,
                                            const std::array<Eigen::Vector2d, 5>& xy2);

}  // namespace plumb
