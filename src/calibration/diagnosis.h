// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calibration/board_intake.h"
#include "calibration/board_refinement.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// What is off in a reconstruction, by markers and photos. `result` holds its tables already.
std::vector<CalibrationFinding> Diagnose(const CalibrationOptions& options,
                                         const std::vector<CalibrationPhoto>& photos,
                                         const BoardIntake& intake,
                                         const BoardSolution& solution,
                                         const CalibrationResult& result);

}  // namespace plumb
