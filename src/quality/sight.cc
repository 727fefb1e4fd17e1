// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  max_radius2 = extent.radius2;
  sides = {Eigen::Vector3d(1.0, 0.0, -extent.min.x()).normalized(),
           Eigen::Vector3d(-1.0, 0.0, extent.max.x()).normalized(),
           Eigen::Vector3d(0.0, 1.0, -extent.min.y()).normalized(),
           Eigen::Vector3d(0.0, -1.0, extent.max.y()).normalized()};
}

Sight::Sight(std::shared_ptr<const Lens> lens, const Rigid3& cam_from_map)
    : lens_(std::move(lens)),
      cam_from_map_(cam_from_map),
      rotation_(cam_from_map.rotation.toRotationMatrix()),
      eye_in_map_(cam_from_map.TargetOriginInSource()) {}

bool Sight::MayShow(const Eigen::Vector3d& center_in_map, double radius) const {
  const Eigen::Vector3d center_in_cam = rotation_ * center_in_map + cam_from_map_.translation;
  if (center_in_cam.z() < -radius) return false;
  return std::all_of(lens_->sides.begin(), lens_->sides.end(), [&](const Eigen::Vector3d& inward) {
    return inward.dot(center_in_cam) >= -radius;
  });
}

std::optional<PixelByPoint> Sight::Look(const Eigen::Vector3d& point_in_map) const {
  const Eigen::Vector3d point_in_cam = rotation_ * point_in_map + cam_from_map_.translation;
  if (!(point_in_cam.z() > 0.0)) return std::nullopt;
  const double radius2 = point_in_cam.head<2>().squaredNorm();
  if (!(radius2 <= lens_->max_radius2 * point_in_cam.z() * point_in_cam.z())) return std::nullopt;
  const auto pixel = lens_->camera.Project(point_in_cam);
  if (!pixel || !lens_->camera.IsInImage(*pixel)) return std::nullopt;
  return JacobianAt(point_in_cam);
}

PixelByPoint Sight::Jacobian(const Eigen::Vector3d& point_in_map) const {
  return JacobianAt(rotation_ * point_in_map + cam_from_map_.translation);
}

// Derivative of Distort and ProjectToPixel (camera/projection.h).
PixelByPoint Sight::JacobianAt(const Eigen::Vector3d& point_in_cam) const {
  const LensParameters<double>& lens = lens_->camera.lens();
  const double x = point_in_cam.x() / point_in_cam.z();
  const double y = point_in_cam.y() / point_in_cam.z();
  const double r2 = x * x + y * y;
  const double numerator = 1.0 + r2 * (lens[kK1] + r2 * (lens[kK2] + r2 * lens[kK3]));
  const double denominator = 1.0 + r2 * (lens[kK4] + r2 * (lens[kK5] + r2 * lens[kK6]));
  const double radial = numerator / denominator;
  const double numerator_by_r2 = lens[kK1] + r2 * (2.0 * lens[kK2] + 3.0 * r2 * lens[kK3]);
  const double denominator_by_r2 = lens[kK4] + r2 * (2.0 * lens[kK5] + 3.0 * r2 * lens[kK6]);
  const double radial_by_r2 = (numerator_by_r2 - radial * denominator_by_r2) / denominator;
  const double mixed = 2.0 * (x * y * radial_by_r2 + lens[kP1] * x + lens[kP2] * y);
  const double x_by_x =
      radial + 2.0 * x * x * radial_by_r2 + 2.0 * lens[kP1] * y + 6.0 * lens[kP2] * x;
  const double y_by_y =
      radial + 2.0 * y * y * radial_by_r2 + 6.0 * lens[kP1] * y + 2.0 * lens[kP2] * x;
  const double fx = lens[kFx] / point_in_cam.z();
  const double fy = lens[kFy] / point_in_cam.z();
  PixelByPoint by_point_in_cam;
  by_point_in_cam << fx * x_by_x, fx * mixed, -fx * (x_by_x * x + mixed * y),  //
      fy * mixed, fy * y_by_y, -fy * (mixed * x + y_by_y * y);
  return by_point_in_cam * rotation_;
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

double StretchOfPixel(const PixelByPoint& pixel_by_point, const Eigen::Vector3d& unit_normal) {
  // Any two perpendicular directions on the plane (Duff et al., Building an orthonormal basis,
  // revisited, JCGT 6(1), 2017).
  const Eigen::Vector3d& n = unit_normal;
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  const Eigen::Vector3d across(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  const Eigen::Vector3d along(b, sign + n.y() * n.y() * a, -n.y());
  const Eigen::Vector2d pixel_by_across = pixel_by_point * across;
  const Eigen::Vector2d pixel_by_along = pixel_by_point * along;
  // Of the 2 x 2 matrix of both: least singular value = |determinant| / largest one.
  const double determinant = pixel_by_across.x() * pixel_by_along.y() -  //
                             pixel_by_across.y() * pixel_by_along.x();
  const double a2 = pixel_by_across.squaredNorm();
  const double b2 = pixel_by_along.squaredNorm();
  const double half_sum = 0.5 * (a2 + b2);
  const double half_difference = 0.5 * (a2 - b2);
  const double product = pixel_by_across.dot(pixel_by_along);
  const double largest2 =
      half_sum + std::sqrt(half_difference * half_difference + product * product);
  return std::sqrt(largest2) / std::abs(determinant);
}

}  // namespace plumb::internal
