// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/CalibrationProgress.h>

#include "ros/calibrator_state.h"

namespace plumb::ros_adapter {

// Without header.
plumbline::CalibrationProgress ToCalibrationProgressMsg(const CalibratorState& state);

}  // namespace plumb::ros_adapter
