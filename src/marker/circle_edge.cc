// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/circle_edge.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace plumb {
namespace {

constexpr double kSampleStepPx = 0.5;
constexpr int kMinDirections = 24;
constexpr int kMaxDirections = 72;
constexpr double kEdgePointDistancePx = 1.2;
constexpr int kNumFits = 3;

// Offset of the steepest rise from the middle [px], in grey values along a ray at steps of
// kSampleStepPx. `sign` is 1 where they rise, -1 where they fall.
std::optional<double> FindRise(const std::vector<int>& values, int sign, double min_step) {
  const int count = static_cast<int>(values.size());
  const auto slope = [&](int i) {
    return sign *
           (values[static_cast<std::size_t>(i + 1)] - values[static_cast<std::size_t>(i - 1)]);
  };
  int steepest = 1;
  for (int i = 2; i + 1 < count; ++i) {
    if (slope(i) > slope(steepest)) steepest = i;
  }
  if (slope(steepest) < min_step * GraySampler::kRayUnit) return std::nullopt;
  const int middle = count / 2;
  double weight_sum = 0.0;
  double sum = 0.0;
  for (int i = std::max(1, steepest - 3); i <= std::min(count - 2, steepest + 3); ++i) {
    const double weight = std::max(0, slope(i));
    weight_sum += weight;
    sum += weight * (i - middle);
  }
  return kSampleStepPx * sum / weight_sum;
}

// Points within a distance of an ellipse along the rays from its centre.
std::vector<Eigen::Vector2d> PointsNear(const std::vector<Eigen::Vector2d>& points_px,
                                        const Ellipse& ellipse,
                                        double max_distance_px) {
  const Eigen::Matrix2d circle_from_pixel = ellipse.PixelFromCircle().inverse();
  std::vector<Eigen::Vector2d> near;
  near.reserve(points_px.size());
  for (const Eigen::Vector2d& point : points_px) {
    const Eigen::Vector2d from_center = point - ellipse.center_px;
    const double radius = (circle_from_pixel * from_center).norm();
    if (std::abs(1.0 - 1.0 / radius) * from_center.norm() <= max_distance_px) {
      near.push_back(point);
    }
  }
  return near;
}

// Edge points on the rays from the centre; none once too few can be left.
std::vector<Eigen::Vector2d> FindEdgePoints(const GraySampler& gray,
                                            const Ellipse& ellipse,
                                            const EdgeSearch& search,
                                            int num_directions,
                                            int min_points) {
  const Eigen::Matrix2d pixel_from_circle = ellipse.PixelFromCircle();
  const int half_count = static_cast<int>(std::ceil(search.reach_px / kSampleStepPx));
  const int sign = search.is_dark_inside ? 1 : -1;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2.0 * M_PI / num_directions).toRotationMatrix();
  std::vector<Eigen::Vector2d> points_px;
  points_px.reserve(static_cast<std::size_t>(num_directions));
  std::vector<int> values(static_cast<std::size_t>(2 * half_count + 1));
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  for (int i = 0; i < num_directions; ++i, direction = turn * direction) {
    const Eigen::Vector2d ray = pixel_from_circle * direction;
    const Eigen::Vector2d outward = ray.normalized();
    const Eigen::Vector2d step = kSampleStepPx * outward;
    gray.SampleRay(ellipse.center_px + ray - half_count * step, step, &values);
    const std::optional<double> offset_px = FindRise(values, sign, search.min_step);
    if (offset_px) points_px.push_back(ellipse.center_px + ray + *offset_px * outward);
    const int num_left = num_directions - 1 - i;
    if (static_cast<int>(points_px.size()) + num_left < min_points) return {};
  }
  return points_px;
}

}  // namespace

std::optional<Ellipse> RefineEllipse(const GraySampler& gray,
                                     const Ellipse& ellipse,
                                     const EdgeSearch& search) {
  if (!gray.ContainsSquare(ellipse.center_px, ellipse.semi_major_px + search.reach_px + 1.0)) {
    return std::nullopt;
  }
  const double mean_radius_px = 0.5 * (ellipse.semi_major_px + ellipse.semi_minor_px);
  const int num_directions =
      std::clamp(static_cast<int>(2.0 * M_PI * mean_radius_px / kEdgePointDistancePx),
                 kMinDirections,
                 kMaxDirections);
  const int min_points = static_cast<int>(search.min_share * num_directions);
  const std::vector<Eigen::Vector2d> points_px =
      FindEdgePoints(gray, ellipse, search, num_directions, min_points);
  std::vector<Eigen::Vector2d> agreeing_px = points_px;
  std::optional<Ellipse> result;
  for (int i = 0; i < kNumFits; ++i) {
    if (static_cast<int>(agreeing_px.size()) < min_points) return std::nullopt;
    result = FitEllipse(agreeing_px);
    if (!result) return std::nullopt;
    std::vector<Eigen::Vector2d> near_px =
        PointsNear(points_px, *result, 0.4 + 0.02 * mean_radius_px);
    const bool is_settled = near_px == agreeing_px;
    agreeing_px = std::move(near_px);
    if (is_settled) break;
  }
  if (static_cast<int>(agreeing_px.size()) < min_points) return std::nullopt;
  return result;
}

}  // namespace plumb
