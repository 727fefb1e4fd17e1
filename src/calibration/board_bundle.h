// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calibration/board.h"

namespace plumb {

struct BoardBundleSettings {
  // Of the lens. With square pixels fy is fx and its own entry says nothing.
  std::array<bool, kNumLensParameters> is_free{};
  bool has_square_pixels = true;
  bool is_flat = false;            // All heights 0.
  double height_sigma = 0.02;      // [marker diameters]
  double noise_factor = 1.0;       // On the standard deviations of all centres.
  double robust_width = 2.5;       // [standard deviations]
  double prior_focal_px = 1000.0;  // Tells the field for which distortion is held small.
  int max_iterations = 50;
  int num_threads = 1;
};

struct BoardBundleReport {
  bool is_usable = false;
  double cost = 0.0;  // Half the sum of squares, robust, in variances.
};

// Least squares over lens, poses and centres (bundle adjustment) from `state`.
BoardBundleReport SolveBoard(const Board& board,
                             const BoardBundleSettings& settings,
                             BoardState* state);

// Covariance at `state`, which is a minimum: lens, then the heights of the centres, 0 for what is
// held. Empty if it is not determined. Of lens [0, kNumLensParameters), height i at
// kNumLensParameters + i.
Eigen::MatrixXd BoardCovariance(const Board& board,
                                const BoardBundleSettings& settings,
                                const BoardState& state);

// Pixel that a state predicts for a view, less what was seen, whitened: standard deviations at a
// noise factor of 1. Infinite behind the camera.
Eigen::Vector2d WhitenedResidual(const MarkerView& view, const BoardState& state);

// Seen less predicted [px].
Eigen::Vector2d PixelResidual(const MarkerView& view, const BoardState& state);

}  // namespace plumb
