// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibrator_state.h"

#include <algorithm>

namespace plumb::ros_adapter {
namespace {

// Of the same plane at different tilts: two leave focal length and distance mixed up.
constexpr int kMinPhotos = 3;

}  // namespace

ShownEstimate EstimateToShow(const CalibratorState& state) {
  const auto show = [](const auto& source) {
    return ShownEstimate{source.estimate ? &*source.estimate : nullptr,
                         source.rms_px,
                         source.verdict,
                         &source.advice,
                         &source.findings,
                         &source.coverage};
  };
  return state.result && state.is_result_current ? show(*state.result) : show(state.progress);
}

bool IsEnough(const CalibratorState& state) {
  return EstimateToShow(state).verdict == CalibrationVerdict::kGood;
}

bool CanCalibrate(const CalibratorState& state) {
  return state.busy.empty() && state.progress.coverage.num_photos >= kMinPhotos &&
         !state.is_result_current;
}

bool CanSave(const CalibratorState& state) {
  return state.busy.empty() && WhyNotSave(state.result.get()).empty() && !state.is_saved;
}

bool CanCommit(const CalibratorState& state) {
  return state.busy.empty() && state.has_driver && !state.is_committed &&
         WhyNotCommit(state.result.get()).empty();
}

std::string WhyNotSave(const CalibrationResult* result) {
  if (result == nullptr) return "Nothing is calibrated yet: press Calibrate first.";
  if (!result->estimate) return "The calibration has failed: " + result->advice;
  return {};
}

std::string WhyNotCommit(const CalibrationResult* result) {
  std::string reason = WhyNotSave(result);
  if (!reason.empty()) return reason;
  const auto serious = std::find_if(result->findings.begin(),
                                    result->findings.end(),
                                    [](const auto& finding) { return finding.is_serious; });
  if (serious == result->findings.end()) return {};
  return "The camera does not get a calibration that cannot be relied on: " + serious->text;
}

}  // namespace plumb::ros_adapter
