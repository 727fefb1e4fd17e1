// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plumbline/image/features.h"

namespace plumb {

// Finds the features near a pixel. Thread-safe: immutable.
class FeatureGrid {
 public:
  // `features` may lie anywhere; those outside the image are kept in border cells.
  FeatureGrid(const std::vector<Feature>& features, int width_px, int height_px, int cell_px = 32);

  // Replaces `indices` by those of all features within `radius_px` of `pixel`, ascending.
  void FindWithin(const Eigen::Vector2d& pixel,
                  double radius_px,
                  std::vector<std::uint32_t>* indices) const;

 private:
  int CellOf(double x_px, double y_px) const;

  int cell_px_;
  int num_columns_;
  int num_rows_;
  std::vector<Eigen::Vector2f> pixels_;
  std::vector<std::uint32_t> cell_begin_;  // Into sorted_; one more than there are cells.
  std::vector<std::uint32_t> sorted_;      // Feature indices by cell, ascending within one.
};

}  // namespace plumb
