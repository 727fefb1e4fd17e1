// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "camera/lens_field.h"

namespace plumb::internal {
namespace {

constexpr int kBorderSteps = 16;  // A side of the photo is followed in so many.

// The curved border of the photo lies a little outside of the points followed, and a centre may
// be on it by rounding.
constexpr double kMargin = 1.01;

// The bounds of the photo in normalised coordinates.
struct Extent {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
  double radius2 = 0.0;

  void Extend(const Eigen::Vector2d& xy) {
    min = min.cwiseMin(xy);
    max = max.cwiseMax(xy);
    radius2 = std::max(radius2, xy.squaredNorm());
  }
};

Extent ExtentOf(const Camera& camera) {
  Extent extent;
  for (int step = 0; step <= kBorderSteps; ++step) {
    const double along = static_cast<double>(step) / kBorderSteps;
    const double x = along * camera.width_px() - 0.5;
    const double y = along * camera.height_px() - 0.5;
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(x, -0.5),
                                         Eigen::Vector2d(x, camera.height_px() - 0.5),
                                         Eigen::Vector2d(-0.5, y),
                                         Eigen::Vector2d(camera.width_px() - 0.5, y)}) {
      if (const auto xy = camera.Unproject(pixel)) extent.Extend(*xy);
    }
  }
  extent.min *= kMargin;
  extent.max *= kMargin;
  extent.radius2 *= kMargin * kMargin;
  return extent;
}

}  // namespace

Lens::Lens(const Camera& camera) : camera(camera) {
  const Extent extent = ExtentOf(camera);
  const double field_radius = OneToOneRadius(camera.lens());
  max_radius2 = std::min(extent.radius2, field_radius * field_radius);
  sides = {Eigen::Vector3d(1.0, 0.0, -extent.min.x()).normalized(),
           Eigen::Vector3d(-1.0, 0.0, extent.max.x()).normalized(),
           Eigen::Vector3d(0.0, 1.0, -extent.min.y()).normalized(),
           Eigen::Vector3d(0.0, -1.0, extent.max.y()).normalized()};
}

Sight::Sight(std::shared_ptr<const Lens> lens, const Rigid3& cam_from_map)
    : lens_(std::move(lens)),
      cam_from_map_(cam_from_map),
      rotation_(cam_from_map.rotation.toRotationMatrix()),
      eye_in_map_(cam_from_map.TargetOriginInSource()) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers_.rotation.data()) = rotation_;
  Eigen::Map<Eigen::Vector3d>(numbers_.translation.data()) = cam_from_map.translation;
  Eigen::Map<Eigen::Vector3d>(numbers_.eye.data()) = eye_in_map_;
  numbers_.lens = lens_->camera.lens();
  numbers_.max_radius2 = lens_->max_radius2;
  numbers_.width_px = lens_->camera.width_px();
  numbers_.height_px = lens_->camera.height_px();
}

bool Sight::MayShow(const Eigen::Vector3d& center_in_map, double radius) const {
  const Eigen::Vector3d center_in_cam = rotation_ * center_in_map + cam_from_map_.translation;
  if (center_in_cam.z() < -radius) return false;
  return std::all_of(lens_->sides.begin(), lens_->sides.end(), [&](const Eigen::Vector3d& inward) {
    return inward.dot(center_in_cam) >= -radius;
  });
}

ImageRect Sight::RectOf(const Eigen::Vector3d& box_min, const Eigen::Vector3d& box_max) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ImageRect rect;
  rect.min.setConstant(kInfinity);
  rect.max.setConstant(-kInfinity);
  rect.min_depth = kInfinity;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d point((corner & 1) != 0 ? box_max.x() : box_min.x(),
                                (corner & 2) != 0 ? box_max.y() : box_min.y(),
                                (corner & 4) != 0 ? box_max.z() : box_min.z());
    const Eigen::Vector3d point_in_cam = rotation_ * point + cam_from_map_.translation;
    rect.min_depth = std::min(rect.min_depth, point_in_cam.z());
    rect.max_depth = std::max(rect.max_depth, point_in_cam.z());
    if (point_in_cam.z() <= 0.0) continue;
    rect.min = rect.min.cwiseMin(point_in_cam.head<2>() / point_in_cam.z());
    rect.max = rect.max.cwiseMax(point_in_cam.head<2>() / point_in_cam.z());
  }
  if (rect.min_depth <= 0.0) {
    rect.min.setConstant(-kInfinity);
    rect.max.setConstant(kInfinity);
  }
  return rect;
}

Eigen::Vector3d Sight::Seen(const Eigen::Vector3d& point_in_map) const {
  const Eigen::Vector3d point_in_cam = rotation_ * point_in_map + cam_from_map_.translation;
  return {
      point_in_cam.x() / point_in_cam.z(), point_in_cam.y() / point_in_cam.z(), point_in_cam.z()};
}

}  // namespace plumb::internal
