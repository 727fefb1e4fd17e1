// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// Calibrates a camera from photos of coded markers in a plane. Whatever the photos hold, it is a
// result with a verdict and findings. `camera_name` goes into the camera. Some 12 photos of 16
// markers take a fraction of a second. Deterministic; thread-safe: holds no state.
//
// Throws std::invalid_argument if options.Problems() is not empty.
CalibrationResult CalibrateCamera(const CalibrationOptions& options,
                                  const std::vector<CalibrationPhoto>& photos,
                                  const std::string& camera_name = "camera");

}  // namespace plumb
