// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "test/matching/random_descriptors.h"

namespace plumb {

// Photos along a wall: photo i sees the points [i * step, i * step + width) of a row of random
// descriptors, each a little different in every photo.
inline std::vector<DescriptorMatrix> PhotosAlongAWall(int num_photos, unsigned seed) {
  constexpr int kWidth = 300;
  constexpr int kStep = 60;
  const DescriptorMatrix wall = RandomDescriptors((num_photos - 1) * kStep + kWidth, seed);
  std::vector<DescriptorMatrix> photos;
  for (int i = 0; i < num_photos; ++i) {
    const auto noise_seed = seed + 1 + static_cast<unsigned>(i);
    photos.push_back(Perturbed(wall.middleRows(i * kStep, kWidth), 3, noise_seed));
  }
  return photos;
}

}  // namespace plumb
