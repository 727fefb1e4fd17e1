// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/feature_grid.h"

#include <algorithm>
#include <cmath>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// Index of the cell that holds `coordinate`; the border cells reach to infinity.
int CellIndex(double coordinate, int cell_px, int num_cells) {
  const double cell = std::floor(coordinate / cell_px);
  return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(num_cells - 1)));
}

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Feature>& features,
                         int width_px,
                         int height_px,
                         int cell_px)
    : cell_px_(cell_px) {
  PLUMB_CHECK_GT(width_px, 0);
  PLUMB_CHECK_GT(height_px, 0);
  PLUMB_CHECK_GT(cell_px, 0);
  num_columns_ = (width_px + cell_px - 1) / cell_px;
  num_rows_ = (height_px + cell_px - 1) / cell_px;
  pixels_.reserve(features.size());
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(num_columns_ * num_rows_) + 1, 0);
  std::vector<std::size_t> cells;
  for (const Feature& feature : features) {
    pixels_.emplace_back(feature.x_px, feature.y_px);
    cells.push_back(static_cast<std::size_t>(CellOf(feature.x_px, feature.y_px)));
    ++counts[cells.back() + 1];
  }
  for (std::size_t c = 1; c < counts.size(); ++c) counts[c] += counts[c - 1];
  cell_begin_ = counts;
  sorted_.resize(features.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sorted_[counts[cells[i]]++] = static_cast<std::uint32_t>(i);
  }
}

void FeatureGrid::FindWithin(const Eigen::Vector2d& pixel,
                             double radius_px,
                             std::vector<std::uint32_t>* indices) const {
  indices->clear();
  if (!pixel.allFinite() || !(radius_px >= 0.0)) return;
  const int first_column = CellIndex(pixel.x() - radius_px, cell_px_, num_columns_);
  const int last_column = CellIndex(pixel.x() + radius_px, cell_px_, num_columns_);
  const int first_row = CellIndex(pixel.y() - radius_px, cell_px_, num_rows_);
  const int last_row = CellIndex(pixel.y() + radius_px, cell_px_, num_rows_);
  for (int row = first_row; row <= last_row; ++row) {
    const auto begin = static_cast<std::size_t>(row * num_columns_ + first_column);
    const auto end = static_cast<std::size_t>(row * num_columns_ + last_column) + 1;
    for (std::uint32_t s = cell_begin_[begin]; s < cell_begin_[end]; ++s) {
      const Eigen::Vector2d offset = pixels_[sorted_[s]].cast<double>() - pixel;
      if (offset.squaredNorm() <= radius_px * radius_px) indices->push_back(sorted_[s]);
    }
  }
  std::sort(indices->begin(), indices->end());
}

int FeatureGrid::CellOf(double x_px, double y_px) const {
  return CellIndex(y_px, cell_px_, num_rows_) * num_columns_ +
         CellIndex(x_px, cell_px_, num_columns_);
}

}  // namespace plumb
