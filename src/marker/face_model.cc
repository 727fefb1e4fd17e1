// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/face_model.h"

#include <algorithm>
#include <cmath>

#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

// A value with its derivatives by the coordinate, and by the blur and the growth along it.
struct Edge {
  double value = 0.0;
  double by_coordinate = 0.0;
  double by_sigma = 0.0;
  double by_growth = 0.0;

  Edge& operator+=(const Edge& other) {
    value += other.value;
    by_coordinate += other.by_coordinate;
    by_sigma += other.by_sigma;
    by_growth += other.by_growth;
    return *this;
  }
};

// Blur and growth along a coordinate.
struct LookAlong {
  LookAlong(const EdgeLook& look, double per_pixel)
      : sigma(look.blur * per_pixel), growth(look.growth * per_pixel) {}

  double sigma;
  double growth;
};

// A step from 0 to `height` at coordinate 0. Its upper side has grown.
Edge Step(double coordinate, const LookAlong& look, double height) {
  const double sigma = look.sigma;
  const double scaled = (coordinate + (height > 0.0 ? look.growth : -look.growth)) / sigma;
  if (scaled > 5.0) return {height, 0.0, 0.0, 0.0};
  if (scaled < -5.0) return {};
  const double density = std::exp(-0.5 * scaled * scaled) / (sigma * std::sqrt(2.0 * M_PI));
  return {height * 0.5 * std::erfc(-scaled / std::sqrt(2.0)),
          height * density,
          -height * density * scaled,
          std::abs(height) * density};
}

double CellOf(std::uint32_t word, int cell) {
  const int wrapped = ((cell % kNumCodeBits) + kNumCodeBits) % kNumCodeBits;
  return static_cast<double>((word >> wrapped) & 1U);
}

// The code along the angle [cells], from the steps between the cells within the blur's reach.
Edge CodeAt(std::uint32_t word, double coordinate, const LookAlong& look) {
  const double reach_cells = 5.0 * look.sigma + std::abs(look.growth);
  const int reach = std::min(kNumCodeBits / 2, static_cast<int>(std::ceil(reach_cells)));
  const int middle = static_cast<int>(std::floor(coordinate));
  Edge code;
  code.value = CellOf(word, middle - reach - 1);
  for (int cell = middle - reach; cell <= middle + reach + 1; ++cell) {
    const double height = CellOf(word, cell) - CellOf(word, cell - 1);
    if (height != 0.0) code += Step(coordinate - cell, look, height);
  }
  return code;
}

}  // namespace

Whiteness BlurredFace(std::uint32_t word,
                      const Eigen::Vector2d& point_in_marker,
                      const Eigen::Matrix2d& marker_from_pixel,
                      const EdgeLook& look) {
  constexpr double kCellsPerRad = kNumCodeBits / (2.0 * M_PI);
  const double radius = std::max(point_in_marker.norm(), 1e-3);
  const Eigen::Vector2d outward = point_in_marker / radius;
  const Eigen::Vector2d along(-outward.y(), outward.x());
  const double radial_per_pixel = (outward.transpose() * marker_from_pixel).norm();
  const double cells_per_length = kCellsPerRad / radius;
  const double cells_per_pixel = (along.transpose() * marker_from_pixel).norm() * cells_per_length;
  const LookAlong radial(look, radial_per_pixel);

  Edge rings = Step(radius - kDiscRadius, radial, -1.0);
  rings += Step(radius - 1.0, radial, 1.0);
  rings.value += 1.0;
  Edge stripe = Step(radius - kStripeInnerRadius, radial, 1.0);
  stripe += Step(radius - kStripeOuterRadius, radial, -1.0);
  Whiteness face;
  face.value = rings.value;
  face.by_point = rings.by_coordinate * outward;
  face.by_blur = rings.by_sigma * radial_per_pixel;
  face.by_growth = rings.by_growth * radial_per_pixel;
  if (stripe.value <= 0.0) return face;
  const double cell = std::atan2(outward.y(), outward.x()) * kCellsPerRad;
  const Edge code = CodeAt(word, cell, {look, cells_per_pixel});
  face.value += stripe.value * code.value;
  face.by_point += stripe.by_coordinate * code.value * outward +
                   stripe.value * code.by_coordinate * cells_per_length * along;
  face.by_blur += stripe.by_sigma * radial_per_pixel * code.value +
                  stripe.value * code.by_sigma * cells_per_pixel;
  face.by_growth += stripe.by_growth * radial_per_pixel * code.value +
                    stripe.value * code.by_growth * cells_per_pixel;
  return face;
}

}  // namespace plumb
