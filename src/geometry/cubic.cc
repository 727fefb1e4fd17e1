// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/cubic.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb {
namespace {

// An outer root of x^3 + b x^2 + c x + d: of three real ones, that with the wider gap to
// the middle one (Press et al., Numerical Recipes, 3rd ed., ch. 5.6).
double OuterRoot(double b, double c, double d) {
  const double third = b / 3.0;
  const double q = third * third - c / 3.0;
  const double r = third * (third * third - 0.5 * c) + 0.5 * d;
  const double r2 = r * r;
  const double q3 = q * q * q;
  if (r2 < q3) {
    // Roots -2 sqrt(q) cos((angle + 2 pi k) / 3); the outlying one lies opposite to r.
    const double angle = std::acos(std::clamp(std::abs(r) / std::sqrt(q3), 0.0, 1.0));
    return std::copysign(2.0 * std::sqrt(q) * std::cos(angle / 3.0), -r) - third;
  }
  const double e = -std::copysign(std::cbrt(std::abs(r) + std::sqrt(r2 - q3)), r);
  return (e != 0.0 ? e + q / e : 0.0) - third;
}

double Polish(const std::array<double, 4>& c, double x) {
  for (int i = 0; i < 3; ++i) {
    const double value = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
    const double slope = c[1] + x * (2.0 * c[2] + 3.0 * x * c[3]);
    const double next = x - value / slope;
    if (!std::isfinite(next)) break;
    x = next;
  }
  return x;
}

}  // namespace

std::optional<HomogeneousRoot> BestRealRoot(const std::array<double, 4>& coefficients) {
  std::array<double, 4> c = coefficients;
  // Solve for the reciprocal where that keeps the leading coefficient away from zero.
  const bool reversed = std::abs(c[0]) > std::abs(c[3]);
  if (reversed) std::reverse(c.begin(), c.end());
  double root = 0.0;
  if (c[3] != 0.0) {
    root = Polish(c, OuterRoot(c[2] / c[3], c[1] / c[3], c[0] / c[3]));
  } else if (c[1] == 0.0 && c[2] == 0.0) {
    return std::nullopt;
  }  // Else both ends vanish: zero is a root.
  const double length = std::hypot(root, 1.0);
  HomogeneousRoot result = {root / length, 1.0 / length};
  if (reversed) std::swap(result.numerator, result.denominator);
  return result;
}

}  // namespace plumb
