// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/view_slant.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/sheet_pose.h"
#include "common/median.h"

namespace plumb {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;

// Drones' lenses have 0.6 to 0.8.
constexpr double kUsualFocalPerWidth = 0.7;

// The first whole degree of each bar of tilt but the first.
constexpr long kSlanted_deg = 15;
constexpr long kTilted_deg = 30;
constexpr long kSteep_deg = 46;

// In whole degrees, as the report tells them: a photo of 44.9 or 45.1 deg is of 45 to both.
std::size_t TiltBar(long tilt_deg) {
  return tilt_deg < kSlanted_deg ? 0 : tilt_deg < kTilted_deg ? 1 : tilt_deg < kSteep_deg ? 2 : 3;
}

}  // namespace

ViewSlant SlantOf(const Eigen::Quaterniond& cam_from_plane) {
  Eigen::Vector3d away = cam_from_plane * Eigen::Vector3d::UnitZ();
  if (away.z() < 0.0) away = -away;
  // The inverse depth of a plane's points is linear in the image: away . (x, y, 1) over its
  // distance.
  return {std::acos(std::min(1.0, away.z())) * kDegPerRad, away.head<2>()};
}

ViewSlant GuessSlant(const CalibrationPhoto& photo) {
  std::vector<double> ratios;
  std::vector<MarkerView> views;
  for (const MarkerDetection& marker : photo.markers) {
    const double ratio = marker.ellipse.semi_minor_px / marker.ellipse.semi_major_px;
    if (!std::isfinite(ratio)) continue;
    ratios.push_back(ratio);
    views.emplace_back();
    views.back().pixel = marker.center_px;
    views.back().ellipse = marker.ellipse;
  }
  const std::optional<SheetPose> pose =
      FindSheetPose(views,
                    kUsualFocalPerWidth * std::max(photo.width_px, photo.height_px),
                    0.5 * Eigen::Vector2d(photo.width_px - 1, photo.height_px - 1));
  if (pose) return SlantOf(pose->cam_from_sheet.rotation);
  if (ratios.empty()) return {};
  return {std::acos(std::clamp(MedianOf(ratios), 0.0, 1.0)) * kDegPerRad, Eigen::Vector2d::Zero()};
}

void CountSlants(const std::vector<ViewSlant>& slants, CalibrationCoverage* coverage) {
  coverage->tilt = {{"0 to 14 deg", 0, 2},
                    {"15 to 29 deg", 0, 2},
                    {"30 to 45 deg", 0, 3},
                    {"46 deg or more", 0, 0}};
  coverage->direction = {{"near on the left", 0, 1},
                         {"near on the right", 0, 1},
                         {"near at the top", 0, 1},
                         {"near at the bottom", 0, 1}};
  for (const ViewSlant& slant : slants) {
    const long tilt_deg = std::lround(slant.tilt_deg);
    ++coverage->tilt[TiltBar(tilt_deg)].count;
    const Eigen::Vector2d& near_side = slant.near_side;
    if (near_side.isZero(0.0) || tilt_deg < kSlanted_deg) continue;
    const bool is_across = std::abs(near_side.x()) > std::abs(near_side.y());
    const bool is_positive = (is_across ? near_side.x() : near_side.y()) > 0.0;
    ++coverage->direction[(is_across ? 0U : 2U) + (is_positive ? 1U : 0U)].count;
  }
}

}  // namespace plumb
