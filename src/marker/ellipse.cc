// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/ellipse.h"

#include <Eigen/Dense>
#include <cmath>

namespace plumb {
namespace {

constexpr std::size_t kMinPoints = 6;

// Points p = center + scale q, with q about the origin at a mean distance of 1.
struct Normalization {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double scale = 0.0;
};

Normalization Normalize(const std::vector<Eigen::Vector2d>& points) {
  Normalization result;
  const double count = static_cast<double>(points.size());
  for (const Eigen::Vector2d& point : points) result.center += point / count;
  for (const Eigen::Vector2d& point : points) {
    result.scale += (point - result.center).norm() / count;
  }
  return result;
}

// a x^2 + b x y + c y^2 + d x + e y + f = 0.
using Conic = Eigen::Matrix<double, 6, 1>;

std::optional<Conic> FitConic(const std::vector<Eigen::Vector2d>& points, const Normalization& by) {
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mixed = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d q = (point - by.center) / by.scale;
    const Eigen::Vector3d second(q.x() * q.x(), q.x() * q.y(), q.y() * q.y());
    const Eigen::Vector3d first(q.x(), q.y(), 1.0);
    quadratic += second * second.transpose();
    mixed += second * first.transpose();
    linear += first * first.transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(linear);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Matrix3d first_from_second = -solver.solve(mixed.transpose());
  const Eigen::Matrix3d reduced = quadratic + mixed * first_from_second;
  Eigen::Matrix3d constrained;  // Times the inverse of the constraint 4 a c - b^2 = 1.
  constrained << reduced.row(2) / 2.0, -reduced.row(1), reduced.row(0) / 2.0;
  const Eigen::EigenSolver<Eigen::Matrix3d> eigen(constrained);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d second = eigen.eigenvectors().col(i).real();
    if (4.0 * second(0) * second(2) - second(1) * second(1) <= 0.0) continue;
    Conic conic;
    conic << second, first_from_second * second;
    return conic;
  }
  return std::nullopt;
}

}  // namespace

Eigen::Matrix2d Ellipse::PixelFromCircle() const {
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  return axes * Eigen::Vector2d(semi_major_px, semi_minor_px).asDiagonal() * axes.transpose();
}

Ellipse EllipseOfAffine(const Eigen::Vector2d& center_px,
                        const Eigen::Matrix2d& pixel_from_circle) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(pixel_from_circle *
                                                             pixel_from_circle.transpose());
  const Eigen::Vector2d major = eigen.eigenvectors().col(1);
  Ellipse ellipse;
  ellipse.center_px = center_px;
  ellipse.semi_major_px = std::sqrt(eigen.eigenvalues()(1));
  ellipse.semi_minor_px = std::sqrt(std::max(0.0, eigen.eigenvalues()(0)));
  ellipse.angle_rad = std::atan2(major.y(), major.x());
  if (ellipse.angle_rad < 0.0) ellipse.angle_rad += M_PI;
  return ellipse;
}

std::optional<Ellipse> FitEllipse(const std::vector<Eigen::Vector2d>& points_px) {
  if (points_px.size() < kMinPoints) return std::nullopt;
  const Normalization normalization = Normalize(points_px);
  if (!(normalization.scale > 0.0)) return std::nullopt;
  const std::optional<Conic> conic = FitConic(points_px, normalization);
  if (!conic) return std::nullopt;
  Eigen::Matrix2d shape;
  shape << (*conic)(0), (*conic)(1) / 2.0, (*conic)(1) / 2.0, (*conic)(2);
  const Eigen::Vector2d slope((*conic)(3), (*conic)(4));
  const Eigen::Vector2d center = -0.5 * shape.inverse() * slope;
  // On the ellipse (q - center)^T shape (q - center) is this.
  const double level = center.dot(shape * center) - (*conic)(5);
  const Eigen::Matrix2d squared_axes = level * shape.inverse();
  if (!squared_axes.allFinite() || squared_axes.trace() <= 0.0) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(squared_axes);
  if (eigen.eigenvalues()(0) <= 0.0) return std::nullopt;
  return EllipseOfAffine(normalization.center + normalization.scale * center,
                         normalization.scale * eigen.operatorSqrt());
}

}  // namespace plumb
