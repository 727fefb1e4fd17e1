// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/board.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {

// The plane of one photo, told by the shapes of its markers alone.
struct SheetPose {
  // Of a plane frame of its own: x and y in the plane, z towards the camera; lengths in marker
  // diameters.
  Rigid3 cam_from_sheet;
  std::vector<Eigen::Vector2d> centers_in_sheet;  // As the views.
  double misfit = 0.0;  // RMS of the shapes' deviations, as shares of a radius.
};

// The plane in which all ellipses become circles of one size, for a pinhole camera (a lens without
// distortion) of this focal length, with the principal point in the middle. Nothing with fewer than
// three views or if no plane does.
std::optional<SheetPose> FindSheetPose(const std::vector<MarkerView>& views,
                                       double focal_px,
                                       const Eigen::Vector2d& principal_px);

}  // namespace plumb
