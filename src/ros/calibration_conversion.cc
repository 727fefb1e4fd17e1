// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/calibration_conversion.h"

#include <string>
#include <vector>

#include "ros/camera_conversion.h"

namespace plumb::ros_adapter {
namespace {

using Msg = plumbline::CalibrationProgress;

std::uint8_t ToVerdict(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return Msg::GOOD;
    case CalibrationVerdict::kMorePhotos:
      return Msg::MORE_PHOTOS;
    case CalibrationVerdict::kFailed:
      return Msg::FAILED;
  }
  return Msg::FAILED;
}

void AddBars(const char* group, const std::vector<CoverageBar>& bars, Msg* msg) {
  for (const CoverageBar& bar : bars) {
    plumbline::CoverageBar copy;
    copy.group = group;
    copy.label = bar.label;
    copy.count = static_cast<std::uint32_t>(bar.count);
    copy.wanted = static_cast<std::uint32_t>(bar.wanted);
    msg->bars.push_back(copy);
  }
}

void FillCoverage(const CalibrationCoverage& coverage, Msg* msg) {
  msg->num_with_markers = static_cast<std::uint32_t>(coverage.num_photos);
  msg->image_share = coverage.image_share;
  msg->heat_map_cols = static_cast<std::uint32_t>(coverage.num_cols);
  msg->heat_map_rows = static_cast<std::uint32_t>(coverage.num_rows);
  msg->heat_map.assign(coverage.centers_in_cell.begin(), coverage.centers_in_cell.end());
  AddBars("distance", coverage.distance, msg);
  AddBars("tilt", coverage.tilt, msg);
  AddBars("direction", coverage.direction, msg);
  AddBars("turn", coverage.turn, msg);
}

}  // namespace

Msg ToCalibrationProgressMsg(const CalibratorState& state) {
  Msg msg;
  msg.num_photos = static_cast<std::uint32_t>(state.progress.num_photos);
  msg.num_waiting = static_cast<std::uint32_t>(state.num_waiting);
  msg.num_dropped = static_cast<std::uint32_t>(state.num_dropped);
  msg.num_unreadable = static_cast<std::uint32_t>(state.num_unreadable);
  if (state.view) {
    msg.last_photo = state.view->name;
    msg.last_photo_note = state.view->note;
  }
  for (const SourceNote& source : state.sources) {
    if (source.is_trouble) msg.source_troubles.push_back(source.text);
  }
  const ShownEstimate shown = EstimateToShow(state);
  FillCoverage(*shown.coverage, &msg);
  msg.has_estimate = shown.estimate != nullptr;
  if (shown.estimate != nullptr) {
    msg.estimate = ToCameraInfoMsg(shown.estimate->camera);
    msg.focal_sigma_percent = shown.estimate->focal_sigma_percent;
    msg.principal_sigma_px = shown.estimate->principal_sigma_px;
    msg.distortion_sigma_px = shown.estimate->distortion_sigma_px;
    msg.rms_px = shown.rms_px;
  }
  msg.verdict = ToVerdict(shown.verdict);
  msg.advice = *shown.advice;
  for (const CalibrationFinding& finding : *shown.findings) msg.findings.push_back(finding.text);
  msg.can_calibrate = CanCalibrate(state);
  msg.can_save = CanSave(state);
  msg.can_commit = CanCommit(state);
  msg.busy = state.busy;
  msg.outcome = state.outcome.text;
  return msg;
}

}  // namespace plumb::ros_adapter
