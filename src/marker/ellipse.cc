// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/ellipse.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr std::size_t kMinPoints = 6;

// Points p = center + scale q, with q about the origin at a mean square distance of 1.
struct Normalization {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double scale = 0.0;
};

Normalization Normalize(const std::vector<Eigen::Vector2d>& points) {
  Normalization result;
  const double count = static_cast<double>(points.size());
  for (const Eigen::Vector2d& point : points) result.center += point;
  result.center /= count;
  for (const Eigen::Vector2d& point : points) {
    result.scale += (point - result.center).squaredNorm();
  }
  result.scale = std::sqrt(result.scale / count);
  return result;
}

// The largest eigenvalue of a matrix whose eigenvalues are real, by the cosines of the three roots
// of its characteristic polynomial (Smith, Eigenvalues of a symmetric 3 x 3 matrix, CACM 4(4),
// 1961).
double LargestEigenvalue(const Eigen::Matrix3d& matrix) {
  const double third = matrix.trace() / 3.0;
  const Eigen::Matrix3d rest = matrix - third * Eigen::Matrix3d::Identity();
  const double square = (rest * rest).trace() / 6.0;
  if (!(square > 0.0)) return third;
  const double scale = std::sqrt(square);
  const double cosine = std::clamp(rest.determinant() / (2.0 * square * scale), -1.0, 1.0);
  return third + 2.0 * scale * std::cos(std::acos(cosine) / 3.0);
}

// A vector that a matrix of rank two maps to 0: across two of its rows, those that are least
// parallel.
Eigen::Vector3d NullVector(const Eigen::Matrix3d& matrix) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d across = matrix.row(i).cross(matrix.row((i + 1) % 3));
    if (across.squaredNorm() > longest.squaredNorm()) longest = across;
  }
  return longest;
}

// a x^2 + b x y + c y^2 + d x + e y + f = 0.
using Conic = Eigen::Matrix<double, 6, 1>;

// The scatter matrix of (x^2, x y, y^2, x, y, 1), in the blocks of Halir and Flusser. Points about
// their centroid have no mean x and y.
struct Scatter {
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> mixed = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();  // Of x^2, x y, y^2 with 1.
  double count = 0.0;

  // Of x and y.
  Eigen::Matrix2d Linear() const {
    return (Eigen::Matrix2d() << second(0), second(1), second(1), second(2)).finished();
  }
};

Scatter MakeScatter(const std::vector<Eigen::Vector2d>& points, const Normalization& by) {
  Scatter scatter;
  scatter.count = static_cast<double>(points.size());
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d q = (point - by.center) / by.scale;
    const Eigen::Vector3d second(q.x() * q.x(), q.x() * q.y(), q.y() * q.y());
    scatter.quadratic += second * second.transpose();
    scatter.mixed += second * q.transpose();
    scatter.second += second;
  }
  return scatter;
}

// Points on a line, or nearly: the ellipse would be flatter than 1 : 10^6.
constexpr double kMinFlatness = 1e-12;

std::optional<Conic> FitConic(const Scatter& scatter) {
  const Eigen::Matrix2d linear = scatter.Linear();
  const double determinant = linear.determinant();
  if (!(determinant > kMinFlatness * linear.trace() * linear.trace())) return std::nullopt;
  Eigen::Matrix3d first_from_second;
  first_from_second << -linear.inverse() * scatter.mixed.transpose(),
      -scatter.second.transpose() / scatter.count;
  const Eigen::Matrix3d reduced = scatter.quadratic +
                                  scatter.mixed * first_from_second.topRows<2>() +
                                  scatter.second * first_from_second.row(2);
  Eigen::Matrix3d constrained;  // Times the inverse of the constraint 4 a c - b^2 = 1.
  constrained << reduced.row(2) / 2.0, -reduced.row(1), reduced.row(0) / 2.0;
  // The constraint has one positive eigenvalue and two negative ones, and so, as the scatter is
  // positive, has this; that of the ellipse is the positive one.
  const double eigenvalue = LargestEigenvalue(constrained);
  const Eigen::Vector3d second =
      NullVector(constrained - eigenvalue * Eigen::Matrix3d::Identity()).normalized();
  if (!(4.0 * second(0) * second(2) - second(1) * second(1) > 0.0)) return std::nullopt;
  Conic conic;
  conic << second, first_from_second * second;
  return conic;
}

}  // namespace

Eigen::Matrix2d Ellipse::PixelFromCircle() const {
  const double mean_px = (semi_major_px + semi_minor_px) / 2.0;
  const double deviation_px = (semi_major_px - semi_minor_px) / 2.0;
  const double along = deviation_px * std::cos(2.0 * angle_rad);
  const double across = deviation_px * std::sin(2.0 * angle_rad);
  return (Eigen::Matrix2d() << mean_px + along, across, across, mean_px - along).finished();
}

Ellipse EllipseOfSquare(const Eigen::Vector2d& center_px, const Eigen::Matrix2d& square) {
  const double mean = square.trace() / 2.0;
  const double half_difference = (square(0, 0) - square(1, 1)) / 2.0;
  const double deviation = std::hypot(half_difference, square(0, 1));
  Ellipse ellipse;
  ellipse.center_px = center_px;
  ellipse.semi_major_px = std::sqrt(mean + deviation);
  ellipse.semi_minor_px = std::sqrt(std::max(0.0, mean - deviation));
  ellipse.angle_rad = std::atan2(square(0, 1), half_difference) / 2.0;
  if (ellipse.angle_rad < 0.0) ellipse.angle_rad += M_PI;
  return ellipse;
}

Ellipse EllipseOfAffine(const Eigen::Vector2d& center_px,
                        const Eigen::Matrix2d& pixel_from_circle) {
  return EllipseOfSquare(center_px, pixel_from_circle * pixel_from_circle.transpose());
}

std::optional<Ellipse> FitEllipse(const std::vector<Eigen::Vector2d>& points_px) {
  if (points_px.size() < kMinPoints) return std::nullopt;
  const Normalization normalization = Normalize(points_px);
  if (!(normalization.scale > 0.0)) return std::nullopt;
  const std::optional<Conic> conic = FitConic(MakeScatter(points_px, normalization));
  if (!conic) return std::nullopt;
  Eigen::Matrix2d shape;
  shape << (*conic)(0), (*conic)(1) / 2.0, (*conic)(1) / 2.0, (*conic)(2);
  const Eigen::Matrix2d inverse = shape.inverse();
  const Eigen::Vector2d slope((*conic)(3), (*conic)(4));
  const Eigen::Vector2d center = -0.5 * inverse * slope;
  // On the ellipse (q - center)^T shape (q - center) is this.
  const double level = center.dot(shape * center) - (*conic)(5);
  const Eigen::Matrix2d square = normalization.scale * normalization.scale * level * inverse;
  if (!square.allFinite() || square.trace() <= 0.0) return std::nullopt;
  const Ellipse ellipse =
      EllipseOfSquare(normalization.center + normalization.scale * center, square);
  if (ellipse.semi_minor_px <= 0.0) return std::nullopt;
  return ellipse;
}

}  // namespace plumb
