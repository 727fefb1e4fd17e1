// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "quality/sight_kernel.h"

namespace plumb::internal {

// The part of the image plane that something may cover, in normalised undistorted coordinates.
struct ImageRect {
  Eigen::Vector2d min;
  Eigen::Vector2d max;
  double min_depth = 0.0;
  double max_depth = 0.0;

  bool Meets(const ImageRect& other) const {
    return min.x() <= other.max.x() && other.min.x() <= max.x() && min.y() <= other.max.y() &&
           other.min.y() <= max.y();
  }
};

// A camera, and the bounds of what its photos show.
struct Lens {
  explicit Lens(const Camera& camera);

  Camera camera;
  double max_radius2 = 0.0;  // Of the normalised coordinates of the photo's points.
  // Inward normals of the sides of the pyramid of sight, in the camera's frame, unit length.
  std::array<Eigen::Vector3d, 4> sides;
};

// What one photo shows: a camera where it was. Immutable.
class Sight {
 public:
  Sight(std::shared_ptr<const Lens> lens, const Rigid3& cam_from_map);

  const Eigen::Vector3d& eye_in_map() const { return eye_in_map_; }

  // False only if no point of the ball is in the photo.
  bool MayShow(const Eigen::Vector3d& center_in_map, double radius) const;

  // For the kernels.
  const SightNumbers& numbers() const { return numbers_; }

  // What a box covers: all of the plane if it reaches behind the camera.
  ImageRect RectOf(const Eigen::Vector3d& box_min, const Eigen::Vector3d& box_max) const;

  // Where a point is seen, and its depth in z; it must be in front of the camera.
  Eigen::Vector3d Seen(const Eigen::Vector3d& point_in_map) const;

 private:
  std::shared_ptr<const Lens> lens_;
  Rigid3 cam_from_map_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d eye_in_map_;
  SightNumbers numbers_;
};

}  // namespace plumb::internal
