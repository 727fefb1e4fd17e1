// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/center_shift.h"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

using Parameters = Eigen::Matrix<double, 8, 1>;  // Of a homography whose last entry is 1, by rows.

constexpr int kPointsPerCircle = 24;
constexpr int kIterations = 4;
constexpr int kPointsPerBorder = 4;
constexpr double kStep_rad = 1e-4;
// Between cells of the code; their borders hold a face against turning and skewing.
constexpr double kBorderShare = 0.5;
// The face's circles and the share of each that shows an edge.
constexpr std::pair<double, double> kCircles[] = {
    {1.0, 1.0}, {kStripeOuterRadius, 0.5}, {kStripeInnerRadius, 0.5}, {kDiscRadius, 1.0}};

class Face {
 public:
  Face(const MarkerView& view, const BoardState& state)
      : lens_(state.lens),
        cam_from_plane_(state.cams_from_plane[static_cast<std::size_t>(view.photo_idx)]),
        center_(state.centers_in_plane[static_cast<std::size_t>(view.marker_idx)]) {}

  // Raw pixel of a point of the marker, in radii.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector2d& point) const {
    const Eigen::Vector3d in_plane = center_ + 0.5 * Eigen::Vector3d(point.x(), point.y(), 0.0);
    const Eigen::Vector3d in_cam = cam_from_plane_ * in_plane;
    if (!(in_cam.z() > 1e-6)) return std::nullopt;
    Eigen::Vector2d pixel;
    ProjectToPixel(lens_.data(), in_cam.data(), pixel.data());
    return pixel;
  }

 private:
  const LensParameters<double>& lens_;
  const Rigid3& cam_from_plane_;
  const Eigen::Vector3d& center_;
};

Eigen::Vector2d Apply(const Parameters& h, const Eigen::Vector2d& m) {
  const double depth = h(6) * m.x() + h(7) * m.y() + 1.0;
  return Eigen::Vector2d(h(0) * m.x() + h(1) * m.y() + h(2), h(3) * m.x() + h(4) * m.y() + h(5)) /
         depth;
}

// Derivative of a component of Apply along `normal`.
Parameters Derivative(const Parameters& h,
                      const Eigen::Vector2d& m,
                      const Eigen::Vector2d& normal) {
  const double depth = h(6) * m.x() + h(7) * m.y() + 1.0;
  const double along = normal.dot(Apply(h, m));
  Parameters derivative;
  derivative << normal.x() * m.x(), normal.x() * m.y(), normal.x(), normal.y() * m.x(),
      normal.y() * m.y(), normal.y(), -along * m.x(), -along * m.y();
  return derivative / depth;
}

struct EdgePoint {
  Eigen::Vector2d in_marker;
  Eigen::Vector2d pixel;
  Eigen::Vector2d normal;
  double weight;
};

// An edge through `in_marker` along `step`, both in radii, that stands for `weight` times the step.
std::optional<EdgePoint> MakeEdgePoint(const Face& face,
                                       const Eigen::Vector2d& in_marker,
                                       const Eigen::Vector2d& step,
                                       double weight) {
  const auto pixel = face.Project(in_marker);
  const auto next = face.Project(in_marker + step);
  if (!pixel || !next) return std::nullopt;
  const Eigen::Vector2d along = *next - *pixel;
  const double length = along.norm();
  if (!(length > 0.0)) return std::nullopt;
  return EdgePoint{
      in_marker, *pixel, Eigen::Vector2d(-along.y(), along.x()) / length, weight * length};
}

// Circles and the borders of cells, as a face shows them on average; nothing unless all are seen.
std::optional<std::vector<EdgePoint>> EdgesOf(const Face& face) {
  std::vector<EdgePoint> points;
  const auto add = [&](double angle_rad, double radius, bool is_border, double weight) {
    const Eigen::Vector2d outward(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector2d around(-outward.y(), outward.x());
    const Eigen::Vector2d step = kStep_rad * (is_border ? outward : around);
    const auto point = MakeEdgePoint(face, radius * outward, step, weight / kStep_rad);
    if (point) points.push_back(*point);
    return point.has_value();
  };
  for (const auto& [radius, edge_share] : kCircles) {
    const double length = 2.0 * M_PI * radius / kPointsPerCircle;
    for (int i = 0; i < kPointsPerCircle; ++i) {
      const double angle_rad = 2.0 * M_PI * i / kPointsPerCircle;
      if (!add(angle_rad, radius, false, edge_share * length)) return std::nullopt;
    }
  }
  const double length = (kStripeOuterRadius - kStripeInnerRadius) / kPointsPerBorder;
  for (int i = 0; i < kNumCodeBits * kPointsPerBorder; ++i) {
    const int border = i / kPointsPerBorder;
    const double angle_rad = 2.0 * M_PI * border / kNumCodeBits;
    const double radius = kStripeInnerRadius + (i % kPointsPerBorder + 0.5) * length;
    if (!add(angle_rad, radius, true, kBorderShare * length)) return std::nullopt;
  }
  return points;
}

}  // namespace

Eigen::Vector2d CenterShift(const MarkerView& view, const BoardState& state) {
  const Face face(view, state);
  constexpr double kStep = 1e-3;
  const auto center = face.Project({0.0, 0.0});
  const auto right = face.Project({kStep, 0.0});
  const auto below = face.Project({0.0, kStep});
  if (!center || !right || !below) return Eigen::Vector2d::Zero();
  const std::optional<std::vector<EdgePoint>> points = EdgesOf(face);
  if (!points) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d x = (*right - *center) / kStep;
  const Eigen::Vector2d y = (*below - *center) / kStep;
  Parameters h;  // Pixels relative to the centre.
  h << x.x(), y.x(), 0.0, x.y(), y.y(), 0.0, 0.0, 0.0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, 8, 8> normal_matrix = Eigen::Matrix<double, 8, 8>::Zero();
    Parameters right_side = Parameters::Zero();
    for (const EdgePoint& point : *points) {
      const Parameters derivative = Derivative(h, point.in_marker, point.normal);
      const Eigen::Vector2d off = point.pixel - *center - Apply(h, point.in_marker);
      normal_matrix += point.weight * derivative * derivative.transpose();
      right_side += point.weight * point.normal.dot(off) * derivative;
    }
    h += normal_matrix.ldlt().solve(right_side);
  }
  const Eigen::Vector2d shift(h(2), h(5));
  return shift.allFinite() ? shift : Eigen::Vector2d::Zero().eval();
}

}  // namespace plumb
