// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/calibration/calibrator.h"
#include "test/support/calibration_scene.h"

namespace plumb::test {

using Kind = CalibrationFinding::Kind;

// Few steps about the truth, where the search itself is not in question.
inline CalibrationOptions QuickOptions() {
  CalibrationOptions options;
  options.min_focal_per_width = 0.45;
  options.max_focal_per_width = 1.0;
  options.num_focal_steps = 9;
  return options;
}

inline double FocalErrorPercent(const CalibrationResult& result, const Camera& truth) {
  return 100.0 * std::abs(result.estimate->camera.lens()[kFx] / truth.lens()[kFx] - 1.0);
}

inline double PrincipalErrorPx(const CalibrationResult& result, const Camera& truth) {
  const LensParameters<double>& lens = result.estimate->camera.lens();
  return std::hypot(lens[kCx] - truth.lens()[kCx], lens[kCy] - truth.lens()[kCy]);
}

// Nothing if there is none of the kind.
inline std::optional<CalibrationFinding> FindingOf(const CalibrationResult& result, Kind kind) {
  for (const CalibrationFinding& finding : result.findings) {
    if (finding.kind == kind) return finding;
  }
  return std::nullopt;
}

inline std::string TextOf(const CalibrationResult& result) {
  std::string text = result.advice;
  for (const CalibrationFinding& finding : result.findings) text += "\n- " + finding.text;
  return text;
}

}  // namespace plumb::test
