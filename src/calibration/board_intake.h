// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/board.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// What can be used of the photos, and what is wrong with the rest.
struct BoardIntake {
  Board board;
  std::vector<int> marker_ids;                 // Of each marker of the board, ascending.
  std::vector<std::size_t> photo_of_board;     // Place among the given photos, of each.
  std::vector<std::size_t> detection_of_view;  // Place among its photo's markers, of each view.
  std::vector<CalibrationFinding> findings;
  std::vector<LeftOutMarker> left_out;  // Markers of no photo of the board, by ID.
};

// Leaves out photos of another size than most, second ones of a name, markers that are there twice
// or not on the grid, what is not finite, photos with too few markers, markers seen once.
BoardIntake TakeInBoard(const CalibrationOptions& options,
                        const std::vector<CalibrationPhoto>& photos);

}  // namespace plumb
