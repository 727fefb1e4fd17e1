// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace plumb {

// SplitMix64 (Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
inline std::uint64_t MixBits(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

// A seed of its own for each use and index, so that no draw depends on how many others there were.
inline std::uint64_t DeriveSeed(std::uint64_t seed, std::uint64_t use, std::uint64_t index) {
  return MixBits(MixBits(MixBits(seed) ^ use) ^ index);
}

// Random numbers that are the same with every standard library.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  // In [0, 1).
  double Uniform() { return static_cast<double>(MixBits(state_++) >> 11U) * 0x1.0p-53; }

  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  int Index(int size) { return static_cast<int>(Uniform() * size); }
  bool Chance(double share) { return Uniform() < share; }

  double Normal(double sigma) {  // Box and Muller's method.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return sigma * radius * std::cos(2.0 * 3.14159265358979323846 * Uniform());
  }

  Eigen::Vector3d Normal3(double sigma) {
    const double x = Normal(sigma);
    const double y = Normal(sigma);
    return {x, y, Normal(sigma)};
  }

 private:
  std::uint64_t state_;
};

}  // namespace plumb
