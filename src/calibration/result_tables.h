// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calibration/board_intake.h"
#include "calibration/board_refinement.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// A marker's diameter in metres, or 1 if it is not known.
double LengthUnit(const CalibrationOptions& options);

// Names of the photos and IDs of the markers; what is known before an estimate.
void FillNames(const CalibrationOptions& options,
               const std::vector<CalibrationPhoto>& photos,
               const BoardIntake& intake,
               CalibrationResult* result);

// The estimate, and all photos, markers and residuals of it.
void FillEstimate(const CalibrationOptions& options,
                  const std::vector<CalibrationPhoto>& photos,
                  const BoardIntake& intake,
                  const BoardSolution& solution,
                  const std::string& camera_name,
                  CalibrationResult* result);

}  // namespace plumb
