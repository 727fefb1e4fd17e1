// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "plumbline/calibration/calibration_coverage.h"
#include "plumbline/calibration/calibration_photo.h"

namespace plumb {

// How a photo looks at the plane of the markers.
struct ViewSlant {
  double tilt_deg = 0.0;  // Between the plane's normal and the optical axis, 0 to 90.
  // Where in the image (x right, y down) the plane comes nearer; zero if unknown.
  Eigen::Vector2d near_side = Eigen::Vector2d::Zero();
};

// The z axis of `plane` is a normal of it, whichever.
ViewSlant SlantOf(const Eigen::Quaterniond& cam_from_plane);

// By the shapes of the markers, for the focal length of a usual lens; with fewer than three markers
// by their axis ratios, which do not tell the near side.
ViewSlant GuessSlant(const CalibrationPhoto& photo);

// Fills the bars of tilt and direction, in the place of what they held.
void CountSlants(const std::vector<ViewSlant>& slants, CalibrationCoverage* coverage);

}  // namespace plumb
