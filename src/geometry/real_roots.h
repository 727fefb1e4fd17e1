// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace plumb {

constexpr int kRootsDegree = 10;

// The distinct real roots of sum_i coefficients[i] x^i, ascending, to about 1e-14 relative. A
// polynomial whose leading coefficient is zero has none here.
std::vector<double> RealRoots(const std::array<double, kRootsDegree + 1>& coefficients);

}  // namespace plumb
