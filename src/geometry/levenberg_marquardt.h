// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

template <int kSize>
struct LinearizedCost {
  Eigen::Matrix<double, kSize, kSize> hessian = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> gradient = Eigen::Matrix<double, kSize, 1>::Zero();
  double cost = 0.0;  // Not finite where the state is impossible.
};

// Huber's cost of an error and the weight of its square in reweighted least squares.
struct HuberCost {
  double cost;
  double weight;
};

inline HuberCost Huber(double squared_error, double width) {
  if (squared_error <= width * width) return {squared_error, 1.0};
  const double error = std::sqrt(squared_error);
  return {width * (2.0 * error - width), width / error};
}

// Minimises a sum of squares by Levenberg and Marquardt's method with Marquardt's scaling.
// `linearize(state)` gives LinearizedCost<kSize>; `step(state, delta)` gives the moved state.
// Ends when a step lowers the cost by less than 1e-12 of it.
template <int kSize, typename State, typename Linearize, typename Step>
State MinimizeSquares(State state, int max_iterations, Linearize&& linearize, Step&& step) {
  constexpr double kConverged = 1e-12;
  constexpr double kMaxDamping = 1e10;
  double damping = 1e-6;
  LinearizedCost<kSize> current = linearize(state);
  if (!std::isfinite(current.cost)) return state;
  for (int i = 0; i < max_iterations && damping < kMaxDamping; ++i) {
    Eigen::Matrix<double, kSize, kSize> damped = current.hessian;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += std::numeric_limits<double>::min();
    const Eigen::Matrix<double, kSize, 1> delta = -damped.ldlt().solve(current.gradient);
    if (!delta.allFinite()) return state;
    const State next_state = step(state, delta);
    const LinearizedCost<kSize> next = linearize(next_state);
    if (!(next.cost <= current.cost)) {  // Also where it is not a number.
      damping = std::max(damping, 1e-6) * 10.0;
      continue;
    }
    const bool converged = current.cost - next.cost <= kConverged * current.cost;
    state = next_state;
    current = next;
    if (converged) return state;
    damping *= 0.1;
  }
  return state;
}

}  // namespace plumb
