// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {

// A target's centre in a located photo. One photo may hold several of an id: one of them is a
// misread or a second marker of the same id.
struct TargetSighting {
  PhotoId photo;
  Rigid3 cam_from_map;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // Raw.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

struct TriangulationBounds {
  double max_error_px = 4.0;      // Of an accepted sighting.
  double min_parallax_deg = 1.5;  // Largest angle between two of its rays.
  double min_sigma_px = 0.1;      // Sightings are not believed to be better than this.
};

struct TriangulatedTarget {
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  // Of the point, given the poses: inverse of the normal equations, raised where the sightings
  // scatter more than they should.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // [map units^2]
  std::vector<int> used;  // Indices into the sightings; at most one a photo, in two or more photos.
  double rms_error_px = 0.0;
  // The sightings left over agree among themselves on another place: the id is there twice.
  std::optional<Eigen::Vector3d> second_point_in_map;
};

// The point that most photos agree on: every pair of sightings (evenly thinned out if there are
// many) gives a point, the one with the least truncated cost is refined by least squares over the
// sightings within the bound, each weighed by its covariance. Nothing if no two photos agree, or
// only at less parallax than the bound. Deterministic.
std::optional<TriangulatedTarget> TriangulateTarget(const TriangulationBounds& bounds,
                                                    const Camera& camera,
                                                    const std::vector<TargetSighting>& sightings);

}  // namespace plumb
