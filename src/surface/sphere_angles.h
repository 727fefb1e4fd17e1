// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace plumb {

// Cosines are kept in whole hundredths, so that weights made of them are exact.
constexpr std::int32_t kCosineUnit = 100;

// Of each face of a tetrahedron (by the opposite corner), the cosine of the angle between it and
// the circumscribed sphere, seen from inside: 1 if the centre is far on the inner side, -1 if it is
// far on the outer one, 0 for what is too flat to have a sphere. A function of the corners and
// their order.
std::array<std::int8_t, 4> SphereCosines(const std::array<Eigen::Vector3d, 4>& corners);

}  // namespace plumb
