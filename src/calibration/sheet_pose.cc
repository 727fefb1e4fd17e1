// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/sheet_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kStep = 1e-5;
constexpr double kMaxSlope = 20.0;  // tan of 87 deg.
constexpr double kRobustMisfit = 0.1;

// A marker as rays see it: the ray of its centre and how it changes along the ellipse's axes.
struct RayCircle {
  Eigen::Vector3d ray;
  Eigen::Matrix<double, 3, 2> radii;
};

// The plane: all P with P . (slope_x, slope_y, 1) = 1.
Eigen::Vector3d NormalOf(const Eigen::Vector2d& slope) { return slope.homogeneous(); }

// The image of the unit circle in the plane, as the Gram matrix of its radii; nothing if the ray
// does not meet the plane in front of the camera.
std::optional<Eigen::Matrix2d> GramInPlane(const RayCircle& circle, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d normal = NormalOf(slope);
  const double along = normal.dot(circle.ray);
  if (!(along > 1e-3)) return std::nullopt;
  // P = ray / (normal . ray), derived by the ray.
  const Eigen::Matrix<double, 3, 2> radii =
      circle.radii / along - circle.ray * (normal.transpose() * circle.radii) / (along * along);
  return Eigen::Matrix2d(radii.transpose() * radii);
}

// Per circle: two deviations from a circle, and the size against the mean of all (logarithms).
std::optional<Eigen::VectorXd> Misfits(const std::vector<RayCircle>& circles,
                                       const Eigen::Vector2d& slope) {
  const auto count = static_cast<Eigen::Index>(circles.size());
  Eigen::VectorXd misfits(3 * count);
  double mean = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto gram = GramInPlane(circles[static_cast<std::size_t>(i)], slope);
    if (!gram) return std::nullopt;
    const double trace = gram->trace();
    misfits(3 * i) = ((*gram)(0, 0) - (*gram)(1, 1)) / trace;
    misfits(3 * i + 1) = 2.0 * (*gram)(0, 1) / trace;
    misfits(3 * i + 2) = 0.25 * std::log(gram->determinant());  // Of the radius.
    mean += misfits(3 * i + 2) / static_cast<double>(count);
  }
  for (Eigen::Index i = 0; i < count; ++i) misfits(3 * i + 2) -= mean;
  return misfits;
}

// Cauchy's weights, so that one false marker does not turn the plane.
Eigen::VectorXd Weights(const Eigen::VectorXd& misfits) {
  return (1.0 + (misfits.array() / kRobustMisfit).square()).inverse().matrix();
}

double RobustCost(const Eigen::VectorXd& misfits) {
  return (1.0 + (misfits.array() / kRobustMisfit).square()).log().sum();
}

struct Fit {
  Eigen::Vector2d slope;
  double cost = std::numeric_limits<double>::infinity();
};

// Gauss and Newton's method with step halving.
Fit FitSlope(const std::vector<RayCircle>& circles, const Eigen::Vector2d& start) {
  Fit fit{start};
  std::optional<Eigen::VectorXd> misfits = Misfits(circles, start);
  if (!misfits) return fit;
  fit.cost = RobustCost(*misfits);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Eigen::MatrixXd jacobian(misfits->size(), 2);
    for (int k = 0; k < 2; ++k) {
      const auto moved = Misfits(circles, fit.slope + kStep * Eigen::Vector2d::Unit(k));
      if (!moved) return fit;
      jacobian.col(k) = (*moved - *misfits) / kStep;
    }
    const Eigen::VectorXd weights = Weights(*misfits);
    const Eigen::Matrix2d normal =
        jacobian.transpose() * weights.asDiagonal() * jacobian + 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d step =
        -normal.ldlt().solve(jacobian.transpose() * weights.asDiagonal() * *misfits);
    bool improved = false;
    for (int halving = 0; halving < 10 && !improved; ++halving, step *= 0.5) {
      const Eigen::Vector2d slope = fit.slope + step;
      if (!(slope.norm() < kMaxSlope)) continue;
      const auto there = Misfits(circles, slope);
      if (!there || !(RobustCost(*there) < fit.cost)) continue;
      improved = true;
      fit.slope = slope;
      fit.cost = RobustCost(*there);
      misfits = there;
    }
    if (!improved || step.norm() < 1e-7) break;
  }
  return fit;
}

// Flat, and tilted either way by as much as the middle one of the ellipses says.
std::vector<Eigen::Vector2d> Starts(const std::vector<MarkerView>& views) {
  std::vector<Ellipse> ellipses;
  for (const MarkerView& view : views) ellipses.push_back(view.ellipse);
  const auto middle = ellipses.begin() + static_cast<std::ptrdiff_t>(ellipses.size() / 2);
  std::nth_element(ellipses.begin(), middle, ellipses.end(), [](const auto& a, const auto& b) {
    return a.semi_minor_px * b.semi_major_px < b.semi_minor_px * a.semi_major_px;
  });
  const double ratio = std::clamp(middle->semi_minor_px / middle->semi_major_px, 0.1, 1.0);
  const double slope = std::sqrt(1.0 - ratio * ratio) / ratio;
  const Eigen::Vector2d across(-std::sin(middle->angle_rad), std::cos(middle->angle_rad));
  return {Eigen::Vector2d::Zero(), slope * across, -slope * across};
}

// Axes of the plane, z towards the camera.
Eigen::Quaterniond SheetRotation(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d z = -normal.normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(z).normalized();
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return Eigen::Quaterniond(rotation);
}

}  // namespace

std::optional<SheetPose> FindSheetPose(const std::vector<MarkerView>& views,
                                       double focal_px,
                                       const Eigen::Vector2d& principal_px) {
  if (views.size() < 3) return std::nullopt;
  std::vector<RayCircle> circles;
  for (const MarkerView& view : views) {
    RayCircle circle;
    circle.ray = ((view.pixel - principal_px) / focal_px).homogeneous();
    circle.radii.setZero();
    circle.radii.topRows<2>() = view.ellipse.PixelFromCircle() / focal_px;
    circles.push_back(circle);
  }
  Fit best;
  for (const Eigen::Vector2d& start : Starts(views)) {
    const Fit fit = FitSlope(circles, start);
    if (fit.cost < best.cost) best = fit;
  }
  if (!std::isfinite(best.cost)) return std::nullopt;

  std::vector<double> radii;
  for (const RayCircle& circle : circles) {
    radii.push_back(std::pow(GramInPlane(circle, best.slope)->determinant(), 0.25));
  }
  std::nth_element(
      radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  const double unit = 2.0 * radii[radii.size() / 2];  // A diameter, where the plane is at 1.
  const Eigen::Vector3d normal = NormalOf(best.slope);
  SheetPose pose;
  const Eigen::Vector3d origin = Eigen::Vector3d::UnitZ() / unit;  // On the optical axis.
  pose.cam_from_sheet = {SheetRotation(normal), origin};
  const Rigid3 sheet_from_cam = pose.cam_from_sheet.Inverse();
  for (const RayCircle& circle : circles) {
    const Eigen::Vector3d point_in_cam = circle.ray / (normal.dot(circle.ray) * unit);
    pose.centers_in_sheet.emplace_back((sheet_from_cam * point_in_cam).head<2>());
  }
  const Eigen::VectorXd misfits = *Misfits(circles, best.slope);
  pose.misfit = std::sqrt(misfits.squaredNorm() / static_cast<double>(misfits.size()));
  return pose;
}

}  // namespace plumb
