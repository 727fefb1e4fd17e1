// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "plumbline/common/ids.h"

namespace plumb {

// Where things stand for the tetrahedra: on lattices, whose pitches are powers of two. What moves
// within its place on the lattice has not moved, and, unlike with a threshold, the place does not
// depend on where the thing was before.

// Beyond this neither squared distances nor lattices hold.
constexpr double kMaxCoordinate = 1e100;

inline bool IsUsable(const Eigen::Vector3d& point) {
  return point.allFinite() && point.cwiseAbs().maxCoeff() < kMaxCoordinate;
}

// floor(log2(distance)); the square must be positive.
inline int DistanceExponent(double squared_distance) {
  const int exponent = std::ilogb(squared_distance);
  return (exponent - (exponent & 1)) / 2;  // Floored: the remainder of -3 is 1.
}

inline Eigen::Vector3d Snapped(const Eigen::Vector3d& point,
                               int pitch_exponent,
                               const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  const double pitch = std::ldexp(1.0, pitch_exponent);
  Eigen::Vector3d snapped;
  for (int i = 0; i < 3; ++i) {
    snapped[i] = (std::round(point[i] / pitch - offset[i]) + offset[i]) * pitch;
  }
  return snapped;
}

// Of a landmark's own lattice, in pitches, 0..1: on a common lattice the points of a wall would be
// coplanar and cospherical by the thousand. No two ids have the same offset.
inline Eigen::Vector3d LatticeOffset(LandmarkId id) {
  std::uint64_t bits = id.value + 0x9E3779B97F4A7C15ULL;  // splitmix64, a bijection.
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  bits ^= bits >> 31;
  constexpr std::uint64_t kMask = (1U << 21) - 1;
  return {std::ldexp(static_cast<double>(bits & ((kMask << 1) | 1)), -22),
          std::ldexp(static_cast<double>((bits >> 22) & kMask), -21),
          std::ldexp(static_cast<double>(bits >> 43), -21)};
}

// A pitch below which `point` would have more than 2^30 steps is raised to that.
inline int PitchExponent(int distance_exponent, int bits, const Eigen::Vector3d& point) {
  const double largest = point.cwiseAbs().maxCoeff();
  const int pitch_exponent = distance_exponent - bits;
  return largest > 0.0 ? std::max(pitch_exponent, std::ilogb(largest) - 29) : pitch_exponent;
}

}  // namespace plumb
