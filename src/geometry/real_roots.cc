// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/real_roots.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

struct Polynomial {
  std::array<double, kRootsDegree + 1> c = {};
  int degree = 0;

  double operator()(double x) const {
    double value = c[degree];
    for (int i = degree - 1; i >= 0; --i) value = value * x + c[i];
    return value;
  }
};

Polynomial Derivative(const Polynomial& p) {
  Polynomial derivative;
  derivative.degree = p.degree - 1;
  for (int i = 0; i < p.degree; ++i) derivative.c[i] = (i + 1) * p.c[i + 1];
  return derivative;
}

// Divides by the largest coefficient, which changes no sign.
void Normalize(Polynomial* p) {
  double largest = 0.0;
  for (int i = 0; i <= p->degree; ++i) largest = std::max(largest, std::abs(p->c[i]));
  for (int i = 0; i <= p->degree; ++i) p->c[i] /= largest;
}

// The negative remainder of a / b; degree -1 if b divides a to rounding.
Polynomial NegativeRemainder(const Polynomial& a, const Polynomial& b) {
  constexpr double kZero = 1e-14;  // Against coefficients of at most 1.
  Polynomial remainder = a;
  for (int i = a.degree; i >= b.degree; --i) {
    const double factor = remainder.c[i] / b.c[b.degree];
    for (int j = 0; j <= b.degree; ++j) remainder.c[i - b.degree + j] -= factor * b.c[j];
  }
  remainder.degree = b.degree - 1;
  while (remainder.degree >= 0 && std::abs(remainder.c[remainder.degree]) < kZero) {
    --remainder.degree;
  }
  for (int i = 0; i <= remainder.degree; ++i) remainder.c[i] = -remainder.c[i];
  return remainder;
}

// Sturm's sequence: the sign changes lost between a and b are the real roots within.
class SturmSequence {
 public:
  explicit SturmSequence(const Polynomial& p) {
    sequence_[0] = p;
    Normalize(&sequence_[0]);
    sequence_[1] = Derivative(sequence_[0]);
    Normalize(&sequence_[1]);
    length_ = 2;
    while (sequence_[length_ - 1].degree > 0) {
      Polynomial next = NegativeRemainder(sequence_[length_ - 2], sequence_[length_ - 1]);
      if (next.degree < 0) break;
      Normalize(&next);
      sequence_[length_++] = next;
    }
  }

  const Polynomial& polynomial() const { return sequence_[0]; }

  int SignChanges(double x) const {
    int changes = 0;
    double last = sequence_[0](x);
    for (int i = 1; i < length_; ++i) {
      const double value = sequence_[i](x);
      if (value == 0.0) continue;
      changes += (value < 0.0) != (last < 0.0) ? 1 : 0;
      last = value;
    }
    return changes;
  }

 private:
  std::array<Polynomial, kRootsDegree + 1> sequence_;
  int length_ = 0;
};

// The root between two points where the polynomial differs in sign: Newton's method,
// bisection where it leaves the bracket.
double RootInBracket(const Polynomial& p, double low, double high) {
  constexpr int kMaxIterations = 80;
  const bool rises = p(low) < 0.0;
  const Polynomial slope = Derivative(p);
  double x = 0.5 * (low + high);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double value = p(x);
    if (value == 0.0) return x;
    ((value < 0.0) == rises ? low : high) = x;
    double next = x - value / slope(x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-15 * std::abs(x)) return next;
    x = next;
  }
  return x;
}

void FindRoots(const SturmSequence& sturm,
               double low,
               int changes_low,
               double high,
               int changes_high,
               std::vector<double>* roots) {
  const int count = changes_low - changes_high;
  if (count <= 0) return;
  const Polynomial& p = sturm.polynomial();
  const bool brackets = (p(low) < 0.0) != (p(high) < 0.0);
  const double middle = 0.5 * (low + high);
  const bool is_narrow = high - low <= 1e-13 * std::max(std::abs(low), std::abs(high));
  if (count == 1 && brackets) {
    roots->push_back(RootInBracket(p, low, high));
  } else if (is_narrow) {  // Roots nearer to each other than rounding.
    roots->push_back(middle);
  } else {
    const int changes_middle = sturm.SignChanges(middle);
    FindRoots(sturm, low, changes_low, middle, changes_middle, roots);
    FindRoots(sturm, middle, changes_middle, high, changes_high, roots);
  }
}

}  // namespace

std::vector<double> RealRoots(const std::array<double, kRootsDegree + 1>& coefficients) {
  Polynomial p;
  p.c = coefficients;
  p.degree = kRootsDegree;
  if (p.c[kRootsDegree] == 0.0) return {};
  for (const double c : p.c) {
    if (!std::isfinite(c)) return {};
  }
  // Fujiwara's bound of the roots, 2 max |c_(n-k) / c_n|^(1/k).
  double bound = 0.0;
  for (int k = 1; k <= kRootsDegree; ++k) {
    const double ratio = std::abs(p.c[kRootsDegree - k] / p.c[kRootsDegree]);
    bound = std::max(bound, 2.0 * std::pow(ratio, 1.0 / k));
  }
  if (!std::isfinite(bound)) return {};
  const SturmSequence sturm(p);
  std::vector<double> roots;
  FindRoots(sturm, -bound, sturm.SignChanges(-bound), bound, sturm.SignChanges(bound), &roots);
  return roots;
}

}  // namespace plumb
