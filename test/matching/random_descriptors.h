// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "plumbline/image/features.h"

namespace plumb {

// Sparse non-negative rows of Euclidean norm 512, clipped at 255, like RootSIFT descriptors.
inline DescriptorMatrix RandomDescriptors(int num_descriptors, unsigned seed) {
  std::mt19937 generator(seed);
  std::exponential_distribution<float> magnitude(1.0F);
  DescriptorMatrix descriptors(num_descriptors, kDescriptorSize);
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    Eigen::Array<float, kDescriptorSize, 1> histogram;
    for (float& value : histogram) value = std::max(0.0F, magnitude(generator) - 0.5F);
    const auto root = (512.0F * (histogram / histogram.sum()).sqrt()).round().min(255.0F);
    descriptors.row(i) = root.matrix().transpose().cast<std::uint8_t>();
  }
  return descriptors;
}

// The same descriptors seen again: each element moved by at most `amplitude`.
inline DescriptorMatrix Perturbed(const DescriptorMatrix& descriptors,
                                  int amplitude,
                                  unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> noise(-amplitude, amplitude);
  DescriptorMatrix perturbed = descriptors;
  for (Eigen::Index i = 0; i < perturbed.rows(); ++i) {
    for (Eigen::Index k = 0; k < kDescriptorSize; ++k) {
      perturbed(i, k) =
          static_cast<std::uint8_t>(std::clamp(perturbed(i, k) + noise(generator), 0, 255));
    }
  }
  return perturbed;
}

}  // namespace plumb
