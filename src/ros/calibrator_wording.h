// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/calibration/calibration_result.h"
#include "ros/calibrator_state.h"

namespace plumb::ros_adapter {

// "1 photo", "3 photos".
std::string CountOf(int count, const std::string& noun);

// Fixed notation, with a point whatever the locale.
std::string NumberOf(double value, int digits);

// A value and its standard deviation with as many digits as that has a use for (two of its own):
// "1361.92" and "0.25". At most 6 digits.
struct ValueText {
  std::string value;
  std::string sigma;
};
ValueText DescribeValue(double value, double sigma);

// What the calibration gave, and what to do next.
Outcome DescribeResult(const CalibrationResult& result);

// After it was written to a folder.
Outcome DescribeSaved(const CalibrationResult& result, const std::string& folder);

}  // namespace plumb::ros_adapter
