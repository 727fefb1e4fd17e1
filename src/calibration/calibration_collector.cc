// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/calibration/calibration_collector.h"

#include <algorithm>
#include <utility>

#include "calibration/advice.h"
#include "calibration/wording.h"
#include "plumbline/calibration/calibrator.h"
#include "plumbline/common/options.h"

namespace plumb {
namespace {

// About the last estimate, if it was as good as that.
constexpr double kMaxPercentToNarrow = 2.0;
constexpr double kNarrowFactor = 1.25;
constexpr int kNarrowSteps = 8;

CalibrationOptions Checked(const CalibrationOptions& options) {
  ThrowIfProblems("calibration", options.Problems());
  return options;
}

// Only focal lengths near the last estimate; the whole range if there is none to rely on.
CalibrationOptions Narrowed(const CalibrationOptions& options,
                            const std::optional<LensEstimate>& last) {
  if (!last || last->focal_sigma_percent > kMaxPercentToNarrow) return options;
  const double per_width = last->camera.lens()[kFx] / last->camera.width_px();
  CalibrationOptions narrowed = options;
  narrowed.min_focal_per_width = std::max(options.min_focal_per_width, per_width / kNarrowFactor);
  narrowed.max_focal_per_width = std::min(options.max_focal_per_width, per_width * kNarrowFactor);
  narrowed.num_focal_steps = std::min(options.num_focal_steps, kNarrowSteps);
  return narrowed.Problems().empty() ? narrowed : options;
}

bool IsGoodEnough(const CalibrationResult& result) {
  return result.estimate && result.estimate->focal_sigma_percent <= kMaxPercentToNarrow;
}

std::string NoteOn(const std::string& name,
                   const std::vector<CalibrationPhoto>& photos,
                   const CalibrationResult& result) {
  std::string note;
  for (const CalibrationPhoto& photo : photos) {
    if (photo.name == name) note = Count(photo.markers.size(), "marker");
  }
  for (const CalibrationFinding& finding : result.findings) {
    const bool is_named = std::count(finding.photos.begin(), finding.photos.end(), name) > 0;
    if (is_named) note += ". " + finding.text;
  }
  return note;
}

}  // namespace

CalibrationCollector::CalibrationCollector(const CalibrationOptions& options)
    : options_(Checked(options)) {
  progress_.coverage = MeasureCoverage({});
  progress_.advice = NextPhoto(progress_.coverage);
}

CalibrationProgress CalibrationCollector::Add(CalibrationPhoto photo) {
  const std::lock_guard<std::mutex> turn(estimate_mutex_);
  const std::string name = photo.name;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto same =
        std::find_if(photos_.begin(), photos_.end(), [&](const CalibrationPhoto& other) {
          return other.name == name;
        });
    if (same != photos_.end()) photos_.erase(same);
    photos_.push_back(std::move(photo));
  }
  return Estimate(name);
}

CalibrationProgress CalibrationCollector::Remove(const std::string& name) {
  const std::lock_guard<std::mutex> turn(estimate_mutex_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto end = std::remove_if(
        photos_.begin(), photos_.end(), [&](const auto& photo) { return photo.name == name; });
    if (end == photos_.end()) return progress_;
    photos_.erase(end, photos_.end());
  }
  return Estimate("");
}

void CalibrationCollector::Clear() {
  const std::lock_guard<std::mutex> turn(estimate_mutex_);
  const std::lock_guard<std::mutex> lock(mutex_);
  photos_.clear();
  progress_ = {};
  progress_.coverage = MeasureCoverage({});
  progress_.advice = NextPhoto(progress_.coverage);
}

CalibrationProgress CalibrationCollector::progress() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return progress_;
}

std::vector<CalibrationPhoto> CalibrationCollector::photos() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return photos_;
}

CalibrationResult CalibrationCollector::Calibrate(const std::string& camera_name) const {
  return CalibrateCamera(options_, photos(), camera_name);
}

// The caller holds estimate_mutex_.
CalibrationProgress CalibrationCollector::Estimate(const std::string& last_photo) {
  const std::vector<CalibrationPhoto> taken = photos();
  const std::optional<LensEstimate> last = progress().estimate;
  CalibrationResult result = CalibrateCamera(Narrowed(options_, last), taken);
  // An estimate that no longer holds is looked for in the whole range.
  if (last && !IsGoodEnough(result)) result = CalibrateCamera(options_, taken);

  CalibrationProgress progress;
  progress.num_photos = static_cast<int>(taken.size());
  progress.coverage = result.coverage;
  progress.estimate = result.estimate;
  progress.rms_px = result.rms_px;
  progress.verdict = result.verdict;
  progress.advice = result.advice;
  progress.findings = result.findings;
  progress.last_photo = last_photo;
  progress.last_photo_note = NoteOn(last_photo, taken, result);
  const bool lacks_photos =
      std::any_of(result.findings.begin(), result.findings.end(), [](const auto& finding) {
        return finding.kind == CalibrationFinding::Kind::kTooFewPhotos;
      });
  // To begin with nothing is wrong yet.
  const std::string next = NextPhoto(result.coverage);
  if (lacks_photos && result.findings.size() == 1 && !next.empty()) progress.advice = next;
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_ = progress;
  return progress;
}

}  // namespace plumb
