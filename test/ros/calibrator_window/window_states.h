// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "ros/calibrator_state.h"
#include "test/support/calibration_scene.h"
#include "test/support/marker_scene.h"

namespace plumb::test {

// A lens known so well that the focal length has this standard deviation [%].
inline LensEstimate EstimateWith(double focal_sigma_percent) {
  LensEstimate estimate{CalibrationCamera()};
  const double share = focal_sigma_percent / 0.04;
  estimate.sigma = {0.54 * share,
                    0.54 * share,
                    0.61 * share,
                    0.58 * share,
                    4e-4 * share,
                    9e-4 * share,
                    3e-5 * share,
                    3e-5 * share,
                    0.0,
                    0.0,
                    0.0,
                    0.0};
  estimate.focal_sigma_percent = focal_sigma_percent;
  estimate.principal_sigma_px = 0.61 * share;
  estimate.distortion_sigma_px = 0.05 * share;
  return estimate;
}

// The photo `photos[index]` as the looking thread shows it; its picture is drawn at `width_px`.
inline std::shared_ptr<const ros_adapter::CalibratorView> ViewOf(const CalibrationPhoto& photo,
                                                                 int width_px = 800) {
  ros_adapter::CalibratorView view;
  view.name = photo.name;
  view.width_px = photo.width_px;
  view.height_px = photo.height_px;
  view.is_taken = true;
  view.note = std::to_string(photo.markers.size()) + " markers";
  const double scale = static_cast<double>(width_px) / photo.width_px;
  view.gray =
      cv::Mat(static_cast<int>(photo.height_px * scale), width_px, CV_8UC1, cv::Scalar(120));
  for (const MarkerDetection& marker : photo.markers) {
    view.markers.push_back({marker.id, marker.ellipse, true});
    const cv::Point2d center(scale * marker.center_px.x(), scale * marker.center_px.y());
    const cv::Size2f axes(static_cast<float>(2.0 * scale * marker.ellipse.semi_major_px),
                          static_cast<float>(2.0 * scale * marker.ellipse.semi_minor_px));
    const auto angle_deg = static_cast<float>(marker.ellipse.angle_rad * 180.0 / M_PI);
    cv::ellipse(view.gray, cv::RotatedRect(center, axes, angle_deg), cv::Scalar(30), cv::FILLED);
  }
  return std::make_shared<const ros_adapter::CalibratorView>(view);
}

// After the first `num_photos` photos of a round about the markers.
inline ros_adapter::CalibratorState StateAfter(int num_photos) {
  std::vector<CalibrationPhoto> photos = MakeCalibrationPhotos();
  photos.resize(std::min(photos.size(), static_cast<std::size_t>(num_photos)));
  ros_adapter::CalibratorState state;
  state.revision = static_cast<std::uint64_t>(num_photos) + 1;
  state.sources = {{"/media/card: " + std::to_string(num_photos) + " photos", false}};
  state.progress.num_photos = num_photos;
  state.progress.coverage = MeasureCoverage(photos);
  state.progress.advice = "Lay the markers on the floor and photograph all of them from above.";
  if (photos.empty()) return state;
  state.view = ViewOf(photos.back());
  state.progress.last_photo = photos.back().name;
  if (num_photos < 3) return state;
  state.progress.estimate = EstimateWith(0.11);
  state.progress.rms_px = 0.06;
  state.progress.verdict = CalibrationVerdict::kMorePhotos;
  state.progress.advice = "Take two photos from the left, tilted by 30 to 45 deg.";
  return state;
}

// After Calibrate, with a good result.
inline ros_adapter::CalibratorState CalibratedState() {
  ros_adapter::CalibratorState state = StateAfter(12);
  CalibrationResult result;
  result.verdict = CalibrationVerdict::kGood;
  result.advice = "The calibration is good: save it.";
  result.estimate = EstimateWith(0.04);
  result.rms_px = 0.05;
  result.coverage = state.progress.coverage;
  state.result = std::make_shared<const CalibrationResult>(result);
  state.is_result_current = true;
  state.has_driver = true;
  return state;
}

}  // namespace plumb::test
