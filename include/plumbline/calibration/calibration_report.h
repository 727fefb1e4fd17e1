// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// All of a result but the camera's YAML (ToCameraYaml gives that), as JSON.
std::string ToJson(const CalibrationResult& result);

// For people: verdict, lens with standard deviations, findings, photos, markers; its pictures are
// those that WriteCalibrationReport writes.
std::string ToMarkdown(const CalibrationResult& result);

// SVG pictures, white ground, as whole files. Throw std::runtime_error only where Cairo fails.
std::string DrawFocalSearch(const CalibrationResult& result);
std::string DrawResiduals(const CalibrationResult& result);  // Over the image, magnified.
std::string DrawCoverage(const CalibrationResult& result);   // Heat map and bars.
std::string DrawMarkers(const CalibrationResult& result);    // The plane from above, with heights.

// Writes report.md, report.json, focal_search.svg, residuals.svg, coverage.svg, markers.svg and, if
// there is an estimate, camera.yaml into a folder, which is made if it is not there. Throws
// std::runtime_error naming the file and what the disk says.
void WriteCalibrationReport(const CalibrationResult& result, const std::string& folder);

}  // namespace plumb
