// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

// Where one view sees a point: (X/Z, Y/Z) in its camera frame, free of distortion.
struct NormalizedObservation {
  const Rigid3* cam_from_map = nullptr;
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
};

// The point in the map that two views see, closest to both observations in the sense of
// the squared normalised reprojection error. Nothing if the rays are parallel (to 1e-6
// rad), the views have one centre, or the point is behind a camera.
std::optional<Eigen::Vector3d> TriangulateTwoViews(const Rigid3& cam1_from_map,
                                                   const Rigid3& cam2_from_map,
                                                   const Eigen::Vector2d& xy1,
                                                   const Eigen::Vector2d& xy2);

// The same for any number of views. Nothing for fewer than two.
std::optional<Eigen::Vector3d> TriangulateViews(
    const std::vector<NormalizedObservation>& observations);

// Angle between the rays from two camera centres to a point [rad], 0 to pi.
double ParallaxAngle(const Eigen::Vector3d& center1,
                     const Eigen::Vector3d& center2,
                     const Eigen::Vector3d& point);

}  // namespace plumb
