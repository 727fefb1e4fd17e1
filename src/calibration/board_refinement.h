// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/board.h"
#include "calibration/focal_search.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/camera/camera.h"

namespace plumb {

// A board that is adjusted with all that is estimated, and what did not fit in.
struct BoardSolution {
  Board board;  // Centres corrected for the distortion over the face; wrong views marked.
  BoardState state;
  Camera camera;
  std::vector<char> is_photo_out;   // Most of its markers fit nothing, or none are shared.
  std::vector<char> is_marker_out;  // Never long at one place, or never placed.
  double cost = 0.0;
  double noise_factor = 1.0;
  double height_sigma = 0.0;
  Eigen::MatrixXd covariance;  // As BoardCovariance; empty if it is not determined.
};

// From a focal length's reconstruction to all of it: in turns the lens, poses and heights are
// adjusted, centres corrected (where `knows_lens` of their photo is 0), views judged, and the noise
// and the heights' spread estimated. Nothing if too few views are left or the lens folds the image.
std::optional<BoardSolution> RefineBoard(const CalibrationOptions& options,
                                         const Board& board,
                                         const std::vector<char>& knows_lens,
                                         const BoardStart& start);

}  // namespace plumb
