// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/lens_field.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

struct Radial {
  double factor;       // g(r2)
  double derivative;   // dg / d(r2)
  double denominator;  // Of g.
};

Radial EvaluateRadial(const LensParameters<double>& lens, double r2) {
  const double numerator = 1.0 + r2 * (lens[kK1] + r2 * (lens[kK2] + r2 * lens[kK3]));
  const double denominator = 1.0 + r2 * (lens[kK4] + r2 * (lens[kK5] + r2 * lens[kK6]));
  const double numerator_slope = lens[kK1] + r2 * (2.0 * lens[kK2] + 3.0 * r2 * lens[kK3]);
  const double denominator_slope = lens[kK4] + r2 * (2.0 * lens[kK5] + 3.0 * r2 * lens[kK6]);
  const double factor = numerator / denominator;
  return {factor, (numerator_slope - factor * denominator_slope) / denominator, denominator};
}

// Whether the Jacobian is regular everywhere on the circle of radius r.
//
// With q = (p2, p1) the tangential part is |x|^2 q + 2 (x.q) x. In the basis (radial,
// tangential) at a point whose direction makes the angle alpha with q, with m = r |q|,
//   J = | d(r g)/dr + 6 m cos(alpha)   2 m sin(alpha)     |
//       | 2 m sin(alpha)               g + 2 m cos(alpha) |
// and det J is a convex parabola in c = cos(alpha), least at its vertex or at an end of [-1, 1].
bool IsRegularOnCircle(const LensParameters<double>& lens, double r) {
  const Radial radial = EvaluateRadial(lens, r * r);
  if (!(radial.denominator > 0.0)) return false;
  const double a = radial.factor + 2.0 * r * r * radial.derivative;
  const double b = radial.factor;
  const double m = r * std::hypot(lens[kP1], lens[kP2]);
  const double c = m > 0.0 ? std::clamp(-(a + 3.0 * b) / (16.0 * m), -1.0, 1.0) : 0.0;
  const double determinant = (a + 6.0 * m * c) * (b + 2.0 * m * c) - 4.0 * m * m * (1.0 - c * c);
  return a > 6.0 * m && b > 2.0 * m && determinant > 0.0;
}

}  // namespace

DistortedPoint DistortWithJacobian(const LensParameters<double>& lens, const Eigen::Vector2d& xy) {
  const double x = xy.x();
  const double y = xy.y();
  const double p1 = lens[kP1];
  const double p2 = lens[kP2];
  const double r2 = xy.squaredNorm();
  const Radial radial = EvaluateRadial(lens, r2);
  const double g = radial.factor;
  const double slope2 = 2.0 * radial.derivative;
  DistortedPoint result;
  result.xy << g * x + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
      g * y + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  const double mixed = slope2 * x * y + 2.0 * (p1 * x + p2 * y);
  result.jacobian << g + slope2 * x * x + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
      g + slope2 * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  return result;
}

double OneToOneRadius(const LensParameters<double>& lens) {
  // The Jacobian is the identity on the axis. Steps of 0.5 % find any fold wider than that.
  constexpr double kGrowth = 1.005;
  double inside = 1e-3;
  if (!IsRegularOnCircle(lens, inside)) return 0.0;
  double outside = inside * kGrowth;
  while (IsRegularOnCircle(lens, outside)) {
    if (outside >= kMaxFieldRadius) return kMaxFieldRadius;
    inside = outside;
    outside = std::min(outside * kGrowth, kMaxFieldRadius);
  }
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    (IsRegularOnCircle(lens, middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace plumb
