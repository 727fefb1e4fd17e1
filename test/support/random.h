// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "plumbline/geometry/rigid3.h"

namespace plumb::test {

// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(int seed) : generator_(static_cast<std::uint32_t>(seed)) {}

  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0);
  }
  int Index(int size) { return static_cast<int>(Uniform(0.0, size)); }

  double Normal(double sigma) {  // Box and Muller's method.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform(0.0, 1.0)));
    return sigma * radius * std::cos(2.0 * 3.14159265358979323846 * Uniform(0.0, 1.0));
  }
  Eigen::Vector2d Normal2(double sigma) {
    const double x = Normal(sigma);
    return {x, Normal(sigma)};
  }
  Eigen::Vector3d InBox(double half_side) {
    const double x = Uniform(-half_side, half_side);
    const double y = Uniform(-half_side, half_side);
    return {x, y, Uniform(-half_side, half_side)};
  }
  Rigid3 Pose(double half_side = 1.0) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(Normal(1.0), Normal(1.0), Normal(1.0)).normalized();
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(Uniform(0.0, 3.14), axis));
    return {rotation, InBox(half_side)};
  }

 private:
  std::mt19937 generator_;
};

}  // namespace plumb::test
