// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_result.h"
#include "plumbline/marker/marker_detector_options.h"
#include "tools/console.h"

namespace plumb::tools {

struct CalibrateArguments {
  std::string photos;       // Folder, with its sub-folders.
  std::string output;       // The camera_info YAML.
  std::string report;       // Folder for the report; empty: none.
  std::string camera_name;  // Goes into the YAML.
  bool detect_once = false;
  bool keep_poor = false;  // Write the YAML even if the verdict is not good.
  CalibrationOptions calibration;
  MarkerDetectorOptions detector;
};

struct CalibrateOutcome {
  CalibrationResult result;
  bool has_written = false;  // The YAML.
};

// Finds the markers of a folder's photos, calibrates, finds them again with the lens then known,
// and calibrates once more. Says on `console` what became of each photo. Writes the report whatever
// the verdict, the YAML if it is good. Throws std::runtime_error for the folder, an option or
// the disk.
CalibrateOutcome Calibrate(const CalibrateArguments& arguments, Console* console);

// What a person must know of a result: verdict, lens, what is off.
std::vector<std::string> Describe(const CalibrationResult& result);

}  // namespace plumb::tools
