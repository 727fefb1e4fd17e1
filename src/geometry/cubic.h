// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

namespace plumb {

// The number numerator / denominator, which may be infinite; a unit vector.
struct HomogeneousRoot {
  double numerator;
  double denominator;
};

// Of the real roots of c[0] + c[1] x + c[2] x^2 + c[3] x^3, infinite ones included, the one
// farthest from its neighbours, to rounding. Nothing if all coefficients are zero.
std::optional<HomogeneousRoot> BestRealRoot(const std::array<double, 4>& coefficients);

}  // namespace plumb
