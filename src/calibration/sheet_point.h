// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calibration/board_refinement.h"

namespace plumb {

// Where the ray of a pixel meets the plane z = height [marker diameters]; nothing if it does not.
// Precondition: the photo has a pose.
inline std::optional<Eigen::Vector2d> PointInPlane(const BoardSolution& solution,
                                                   int photo_idx,
                                                   const Eigen::Vector2d& pixel,
                                                   double height) {
  const std::optional<Eigen::Vector2d> xy = solution.camera.Unproject(pixel);
  if (!xy) return std::nullopt;
  const Rigid3 plane_from_cam =
      solution.state.cams_from_plane[static_cast<std::size_t>(photo_idx)].Inverse();
  const Eigen::Vector3d direction = plane_from_cam.rotation * xy->homogeneous();
  const double along = (height - plane_from_cam.translation.z()) / direction.z();
  if (!(along > 0.0)) return std::nullopt;
  return Eigen::Vector2d((plane_from_cam.translation + along * direction).head<2>());
}

}  // namespace plumb
