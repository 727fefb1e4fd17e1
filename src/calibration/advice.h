// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "plumbline/calibration/calibration_coverage.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// The verdict on a result that has an estimate, and one sentence: that it is good, or what to
// photograph next.
std::pair<CalibrationVerdict, std::string> Advise(const CalibrationOptions& options,
                                                  const CalibrationResult& result);

// What the photos lack most; empty if nothing.
std::string NextPhoto(const CalibrationCoverage& coverage);

}  // namespace plumb
