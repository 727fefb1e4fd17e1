// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/feature_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace plumb {
namespace {

// Fine enough to tell a tree from the facade beside it, coarse enough for a cell to hold dozens.
constexpr int kSelectionCells = 96;

}  // namespace

std::vector<int> SelectExtrema(const std::vector<Extremum>& extrema,
                               const std::vector<Octave>& octaves,
                               PhotoSize size,
                               int max_count) {
  std::vector<int> order(extrema.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return extrema[static_cast<std::size_t>(a)].scale_px >
           extrema[static_cast<std::size_t>(b)].scale_px;
  });

  const double cell_px = std::sqrt(static_cast<double>(size.width_px) * size.height_px /
                                   static_cast<double>(kSelectionCells));
  const int num_columns = static_cast<int>(size.width_px / cell_px) + 1;
  const int num_rows = static_cast<int>(size.height_px / cell_px) + 1;
  std::vector<int> count_of_cell(static_cast<std::size_t>(num_columns * num_rows), 0);
  const int tier_size = std::max(1, 2 * max_count / kSelectionCells);
  std::vector<int> tier_of(extrema.size());
  for (const int idx : order) {
    const Extremum& extremum = extrema[static_cast<std::size_t>(idx)];
    const Octave& octave = octaves[static_cast<std::size_t>(extremum.octave_idx)];
    const auto cell_along = [&](float pixel, int num_cells) {
      const double full_px = pixel * octave.full_px_per_px + octave.full_px_offset;
      return std::clamp(static_cast<int>(full_px / cell_px), 0, num_cells - 1);
    };
    const int cell =
        cell_along(extremum.y, num_rows) * num_columns + cell_along(extremum.x, num_columns);
    tier_of[static_cast<std::size_t>(idx)] =
        count_of_cell[static_cast<std::size_t>(cell)]++ / tier_size;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return tier_of[static_cast<std::size_t>(a)] < tier_of[static_cast<std::size_t>(b)];
  });
  if (static_cast<int>(order.size()) > max_count) order.resize(static_cast<std::size_t>(max_count));
  return order;
}

}  // namespace plumb
