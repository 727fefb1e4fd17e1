// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "plumbline/calibration/calibration_collector.h"
#include "plumbline/calibration/calibration_result.h"
#include "plumbline/marker/ellipse.h"

namespace plumb::ros_adapter {

struct SeenMarker {
  int id = 0;
  Ellipse ellipse;       // In pixels of the full image.
  bool is_used = false;  // Counts for the calibration.
};

// The image that was looked at last.
struct CalibratorView {
  std::string name;
  cv::Mat gray;      // Reduced, CV_8UC1; empty if it could not be read.
  int width_px = 0;  // Of the full image.
  int height_px = 0;
  bool is_taken = false;
  bool is_problem = false;  // It could not be read or searched.
  std::string note;         // What became of it.
  std::vector<SeenMarker> markers;
};

// What became of something that was asked for, in a sentence for the pilot.
struct Outcome {
  enum class Kind { kDone, kDoubtful, kFailed };
  Kind kind = Kind::kDone;
  std::string text;
};

// Where photos come from: a folder or a topic, and how that goes.
struct SourceNote {
  std::string text;
  bool is_trouble = false;
};

// All that a window or a listener shows. Plain values; what is pointed to is never changed.
struct CalibratorState {
  std::uint64_t revision = 0;  // Grows with every change.
  CalibrationProgress progress;
  std::shared_ptr<const CalibratorView> view;       // Null before the first image.
  std::shared_ptr<const CalibrationResult> result;  // Of Calibrate; null before.
  bool is_result_current = false;                   // Every photo taken is in it.
  bool is_saved = false;                            // The result.
  bool is_committed = false;                        // Likewise.
  std::string busy;                                 // What is being done; empty if nothing.
  Outcome outcome;                                  // Of what was asked for last; empty before.
  std::vector<SourceNote> sources;
  bool has_driver = false;      // That Commit could send the calibration to.
  std::size_t num_waiting = 0;  // Images that wait to be looked at.
  std::size_t num_dropped = 0;  // Images of a video that came too fast.
  std::size_t num_unreadable = 0;
};

// The running estimate or, once everything taken is calibrated, that of the result. Points into
// `state`, which must outlive it.
struct ShownEstimate {
  const LensEstimate* estimate = nullptr;  // Null if there is none.
  double rms_px = 0.0;
  CalibrationVerdict verdict = CalibrationVerdict::kFailed;
  const std::string* advice = nullptr;
  const std::vector<CalibrationFinding>* findings = nullptr;
  const CalibrationCoverage* coverage = nullptr;
};
ShownEstimate EstimateToShow(const CalibratorState& state);

// Whether the photos taken are good enough, so that a source may well end.
bool IsEnough(const CalibratorState& state);

// Whether each of the three steps makes sense now.
bool CanCalibrate(const CalibratorState& state);
bool CanSave(const CalibratorState& state);
bool CanCommit(const CalibratorState& state);

// Why a result cannot be used; empty if it can.
std::string WhyNotSave(const CalibrationResult* result);
std::string WhyNotCommit(const CalibrationResult* result);

}  // namespace plumb::ros_adapter
