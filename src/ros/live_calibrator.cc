// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/live_calibrator.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "plumbline/calibration/calibration_report.h"
#include "plumbline/marker/marker_sheet.h"
#include "ros/calibrator_wording.h"
#include "ros/edge_blur.h"

namespace plumb::ros_adapter {
namespace {

constexpr const char* kNoMarkers = "no markers found: go nearer, focus, or give more light";

cv::Mat Reduce(const cv::Mat& gray, int max_width_px) {
  const double scale = static_cast<double>(max_width_px) / gray.cols;
  if (scale >= 1.0) return gray.clone();
  cv::Mat reduced;
  const int height_px = std::max(1, static_cast<int>(std::lround(gray.rows * scale)));
  cv::resize(gray, reduced, {max_width_px, height_px}, 0.0, 0.0, cv::INTER_AREA);
  return reduced;
}

std::vector<SeenMarker> Unused(const std::vector<MarkerDetection>& markers) {
  std::vector<SeenMarker> seen;
  seen.reserve(markers.size());
  for (const MarkerDetection& marker : markers) seen.push_back({marker.id, marker.ellipse, false});
  return seen;
}

}  // namespace

LiveCalibrator::LiveCalibrator(const CalibratorRosOptions& options, OnView on_view)
    : options_(options),
      on_view_(std::move(on_view)),
      collector_(options.calibration),
      choice_(options.views) {
  state_.progress = collector_.progress();
  looking_ = std::make_unique<Stage<Arrived>>(static_cast<std::size_t>(options_.max_queue),
                                              [this](const Arrived& arrived) { Look(arrived); });
}

LiveCalibrator::~LiveCalibrator() { is_stopping_ = true; }

template <typename Change>
void LiveCalibrator::Update(const Change& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  change();
  ++state_.revision;
}

CalibratorState LiveCalibrator::state() const {
  const StageCounters counters = looking_->counters();
  const std::lock_guard<std::mutex> lock(mutex_);
  CalibratorState state = state_;
  state.num_waiting = counters.queue_depth;
  state.num_dropped = counters.dropped;
  return state;
}

void LiveCalibrator::NoteSources(std::vector<SourceNote> sources, bool has_driver) {
  const auto is_same = [](const SourceNote& a, const SourceNote& b) {
    return a.text == b.text && a.is_trouble == b.is_trouble;
  };
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<SourceNote>& before = state_.sources;
  if (state_.has_driver == has_driver &&
      std::equal(sources.begin(), sources.end(), before.begin(), before.end(), is_same)) {
    return;
  }
  state_.sources = std::move(sources);
  state_.has_driver = has_driver;
  ++state_.revision;
}

void LiveCalibrator::TakePhoto(const std::string& name, std::vector<std::uint8_t> bytes) {
  looking_->Push({name, 0.0, [bytes = std::move(bytes)] { return DecodeGrayPhoto(bytes); }});
}

bool LiveCalibrator::OfferImage(double stamp_s, std::function<GrayPhoto()> decode) {
  return looking_->TryPush({std::string(), stamp_s, std::move(decode)});
}

void LiveCalibrator::Look(const Arrived& arrived) {
  if (is_stopping_) return;
  CalibratorView view;
  view.name = arrived.name.empty() ? "live" : arrived.name;
  try {
    const GrayPhoto photo = arrived.decode();
    view.is_problem = !photo.problem.empty();
    view.note = photo.problem;
    if (!view.is_problem) LookAt(photo.gray, arrived, &view);
  } catch (const std::exception& error) {  // One photo must not end the others.
    view.is_problem = true;
    view.is_taken = false;
    view.note = error.what();
  }
  if (view.is_problem) Update([&] { ++state_.num_unreadable; });
  Show(view);
  if (on_view_ && (view.is_taken || view.is_problem || !arrived.name.empty())) on_view_(view);
}

void LiveCalibrator::LookAt(const cv::Mat& gray, const Arrived& arrived, CalibratorView* view) {
  view->gray = Reduce(gray, options_.picture_width_px);
  view->width_px = gray.cols;
  view->height_px = gray.rows;
  std::vector<MarkerDetection> markers = DetectMarkers(options_.detector, gray);
  view->markers = Unused(markers);
  if (arrived.name.empty()) {
    view->note =
        choice_.Judge({arrived.stamp_s, gray.cols, gray.rows, markers, EdgeBlur_px(gray, markers)});
    if (!view->note.empty()) return;
    view->name = "view " + std::to_string(++num_views_);
  } else if (markers.empty()) {
    view->note = kNoMarkers;
    return;
  }
  Collect(gray, std::move(markers), view);
}

// Shows the markers before the estimate, which takes a fraction of a second.
void LiveCalibrator::Collect(const cv::Mat& gray,
                             std::vector<MarkerDetection> markers,
                             CalibratorView* view) {
  view->note = "estimating ...";
  Show(*view);
  std::map<int, int> counts;
  for (const MarkerDetection& marker : markers) ++counts[marker.id];
  const bool has_enough = static_cast<int>(counts.size()) >= options_.views.min_markers;
  const CalibrationProgress progress =
      collector_.Add({view->name, gray.cols, gray.rows, std::move(markers), false});
  view->is_taken = has_enough && progress.coverage.width_px == gray.cols &&
                   progress.coverage.height_px == gray.rows;
  view->note = progress.last_photo_note;
  for (SeenMarker& marker : view->markers) {
    marker.is_used = view->is_taken && counts[marker.id] == 1 && IsCounted(marker.id);
  }
  Update([&] {
    state_.progress = progress;
    state_.is_result_current = false;
    ++num_collected_;
  });
}

bool LiveCalibrator::IsCounted(int id) const {
  const CalibrationOptions& options = options_.calibration;
  return options.fixed_grid.empty() ||
         (id >= options.first_id && id < options.first_id + kGridSide * kGridSide);
}

void LiveCalibrator::Show(const CalibratorView& view) {
  const auto shown = std::make_shared<const CalibratorView>(view);
  Update([&] { state_.view = shown; });
}

Outcome LiveCalibrator::Do(const std::string& busy, const std::function<Outcome()>& action) {
  const std::lock_guard<std::mutex> lock(action_mutex_);
  Update([&] { state_.busy = busy; });
  Outcome outcome;
  try {
    outcome = action();
  } catch (const std::exception& error) {
    outcome = {Outcome::Kind::kFailed, error.what()};
  }
  Update([&] {
    state_.busy.clear();
    state_.outcome = outcome;
  });
  return outcome;
}

Outcome LiveCalibrator::Calibrate() {
  const int num_photos = state().progress.coverage.num_photos;
  return Do("Calibrating " + CountOf(num_photos, "photo") + " ...",
            [this] { return CalibrateNow(); });
}

Outcome LiveCalibrator::CalibrateNow() {
  std::uint64_t num_before = 0;
  Update([&] { num_before = num_collected_; });
  const auto result =
      std::make_shared<const CalibrationResult>(collector_.Calibrate(options_.camera_name));
  Update([&] {
    state_.result = result;
    state_.is_result_current = num_collected_ == num_before;
    state_.is_saved = state_.is_committed = false;
  });
  return DescribeResult(*result);
}

Outcome LiveCalibrator::Save() {
  return Do("Saving ...", [this] { return SaveNow(); });
}

Outcome LiveCalibrator::SaveNow() {
  const std::shared_ptr<const CalibrationResult> result = state().result;
  const std::string reason = WhyNotSave(result.get());
  if (!reason.empty()) return {Outcome::Kind::kFailed, reason};
  KeepEarlierOutput();
  WriteCalibrationReport(*result, options_.output_folder);
  has_saved_ = true;
  Update([&] { state_.is_saved = true; });
  return DescribeSaved(*result, options_.output_folder);
}

// A calibration of an earlier run becomes FOLDER_1, or the first number that is free.
void LiveCalibrator::KeepEarlierOutput() const {
  namespace fs = std::filesystem;
  const fs::path folder = (fs::path(options_.output_folder) / "").parent_path();
  if (has_saved_ || !fs::exists(folder / "report.json")) return;
  int number = 1;
  while (fs::exists(folder.string() + '_' + std::to_string(number))) ++number;
  fs::rename(folder, folder.string() + '_' + std::to_string(number));
}

Outcome LiveCalibrator::Commit(const std::function<Outcome(const Camera&)>& send) {
  return Do("Sending the calibration to the camera ...", [&]() -> Outcome {
    const std::shared_ptr<const CalibrationResult> result = state().result;
    const std::string reason = WhyNotCommit(result.get());
    if (!reason.empty()) return {Outcome::Kind::kFailed, reason};
    Outcome outcome = send(result->estimate->camera);
    if (outcome.kind != Outcome::Kind::kFailed) Update([&] { state_.is_committed = true; });
    return outcome;
  });
}

}  // namespace plumb::ros_adapter
