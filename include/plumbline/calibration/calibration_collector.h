// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/calibration/calibration_coverage.h"
#include "plumbline/calibration/calibration_options.h"
#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/calibration/calibration_result.h"

namespace plumb {

// Where a calibration stands. Plain values, to be copied freely.
struct CalibrationProgress {
  int num_photos = 0;  // Taken in so far.
  CalibrationCoverage coverage;

  // The running estimate with its standard deviations; nothing before it can be made.
  std::optional<LensEstimate> estimate;
  double rms_px = 0.0;  // Of the estimate.

  CalibrationVerdict verdict = CalibrationVerdict::kFailed;
  std::string advice;                        // What to photograph next, or that it is enough.
  std::vector<CalibrationFinding> findings;  // What is off so far.

  std::string last_photo;       // Name of the photo that came last.
  std::string last_photo_note;  // What became of it: "16 markers", or why it does not count.
};

// Takes photos one by one while they are made and says what is still missing.
//
// Thread-safe: every method may be called from any thread. Add, Remove and Clear wait for one
// another; progress and photos never wait for an estimate; Calibrate works on a copy.
class CalibrationCollector {
 public:
  // Throws std::invalid_argument if options.Problems() is not empty.
  explicit CalibrationCollector(const CalibrationOptions& options);

  // Takes a photo in, a second one of the same name in place of the first, and estimates anew,
  // starting from the last estimate: a fraction of a second.
  CalibrationProgress Add(CalibrationPhoto photo);

  // Takes a photo out again; does nothing if there is none of that name.
  CalibrationProgress Remove(const std::string& name);

  void Clear();

  CalibrationProgress progress() const;
  std::vector<CalibrationPhoto> photos() const;  // In the order in which they came.

  // The whole calibration of what was taken in: exhaustive search and all.
  CalibrationResult Calibrate(const std::string& camera_name = "camera") const;

 private:
  CalibrationProgress Estimate(const std::string& last_photo);

  const CalibrationOptions options_;
  std::mutex estimate_mutex_;  // Held while a photo is taken in, for the order of the estimates.
  mutable std::mutex mutex_;   // Guards what follows; never held while estimating.
  std::vector<CalibrationPhoto> photos_;
  CalibrationProgress progress_;
};

}  // namespace plumb
