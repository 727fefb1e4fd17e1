// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/center_alignment.h"

#include <random>

#include "plumbline/geometry/alignment.h"

namespace plumb {
namespace {

constexpr int kNumSamples = 1000;  // Half of the centres wrong: 125 samples are without one.
constexpr int kNumRefinements = 5;

Centers CentersWithin(const Centers& centers, const Similarity3& world_from_map, double bound_m) {
  Centers within;
  for (std::size_t i = 0; i < centers.in_map.size(); ++i) {
    if ((world_from_map * centers.in_map[i] - centers.in_world[i]).norm() > bound_m) continue;
    within.in_map.push_back(centers.in_map[i]);
    within.in_world.push_back(centers.in_world[i]);
  }
  return within;
}

std::optional<Similarity3> AlignAll(const Centers& centers) {
  return AlignPoints(centers.in_map, centers.in_world);
}

Centers DrawThree(const Centers& centers, std::mt19937* random) {
  Centers drawn;
  for (int i = 0; i < 3; ++i) {
    const std::size_t idx = (*random)() % centers.in_map.size();
    drawn.in_map.push_back(centers.in_map[idx]);
    drawn.in_world.push_back(centers.in_world[idx]);
  }
  return drawn;
}

// Empty if no three centres determine a similarity.
Centers LargestAgreement(const Centers& centers, double max_error_m) {
  std::mt19937 random(0);
  Centers largest;
  for (int i = 0; i < kNumSamples; ++i) {
    std::optional<Similarity3> world_from_map = AlignAll(DrawThree(centers, &random));
    for (int k = 0; world_from_map && k < kNumRefinements; ++k) {
      Centers within = CentersWithin(centers, *world_from_map, max_error_m);
      if (within.in_map.size() <= largest.in_map.size()) break;
      world_from_map = AlignAll(within);
      largest = std::move(within);
    }
  }
  return largest;
}

}  // namespace

std::optional<Similarity3> AlignCenters(const Centers& centers, double max_error_m) {
  const std::size_t num_centers = centers.in_map.size();
  const std::optional<Similarity3> of_all = AlignAll(centers);
  if (!of_all || CentersWithin(centers, *of_all, max_error_m).in_map.size() == num_centers) {
    return of_all;
  }
  const Centers agreeing = LargestAgreement(centers, max_error_m);
  if (2 * agreeing.in_map.size() <= num_centers) return of_all;
  const std::optional<Similarity3> of_agreeing = AlignAll(agreeing);
  return of_agreeing ? of_agreeing : of_all;
}

}  // namespace plumb
