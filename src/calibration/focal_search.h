// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "calibration/board.h"
#include "calibration/board_start.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// Centres count as so much less precise than they are while only two terms of the distortion and a
// plane explain them.
constexpr double kSearchNoise = 10.0;

struct FocalCandidate {
  BoardStart start;    // Adjusted: planar, with two radial terms, principal point in the middle.
  double error = 0.0;  // FocalSearch::error.
};

// The best planar reconstruction with one focal length. Nothing if there is none.
std::optional<FocalCandidate> TryFocalLength(const CalibrationOptions& options,
                                             const Board& board,
                                             double focal_px);

struct FocalSearchResult {
  FocalSearch curve;
  // Local minima of the curve that come near the best one, best first. Empty if no focal length
  // gives a reconstruction.
  std::vector<FocalCandidate> candidates;
};

// Tries all focal lengths of the options' range, each on its own.
FocalSearchResult SearchFocalLength(const CalibrationOptions& options, const Board& board);

}  // namespace plumb
