// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace plumb {

// Random numbers that depend on the given keys alone, the same with every standard library: what
// one part of the world draws does not depend on what others drew before.
class HashRandom {
 public:
  HashRandom(std::initializer_list<std::uint64_t> keys) {
    for (const std::uint64_t key : keys) state_ = Mix(state_ + key + kStep);
  }

  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(Next() >> 11U) * 0x1.0p-53);
  }
  int Index(int size) { return static_cast<int>(Uniform(0.0, size)); }
  bool Chance(double share) { return Uniform(0.0, 1.0) < share; }
  double Normal(double sigma) {  // Box and Muller's method.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform(0.0, 1.0)));
    return sigma * radius * std::cos(2.0 * 3.14159265358979323846 * Uniform(0.0, 1.0));
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15U;

  std::uint64_t Next() { return Mix(state_ += kStep); }
  static std::uint64_t Mix(std::uint64_t z) {  // SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_ = 0;
};

}  // namespace plumb
