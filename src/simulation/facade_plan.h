// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "plumbline/geometry/rigid3.h"
#include "simulation/facade_style.h"

namespace plumb {

// A rectangle on a wall: x along it, z up.
using WallRect = Eigen::AlignedBox2d;

inline WallRect MakeRect(double x0, double z0, double x1, double z1) {
  return {Eigen::Vector2d(x0, z0), Eigen::Vector2d(x1, z1)};
}

// What is built at the ends of a wall, above and below the bays.
constexpr double kCornerMargin_m = 0.6;
constexpr double kEntablature_m = 1.2;
constexpr double kRustication_m = 0.04;  // How far the ground storey's blocks stand out.
constexpr double kThreshold_m = 0.34;    // Of the doors: two steps.

enum class BayKind { kBlank, kWindow, kBalcony, kDoor };

struct BayPlan {
  BayKind kind = BayKind::kBlank;
  WallRect cell;
  WallRect opening;  // Empty for a blank bay.
  StoreyStyle style;
  HoodKind hood = HoodKind::kNone;
  std::string copy_key;          // Bays with the same key are copies; empty: unique.
  std::uint64_t random_key = 0;  // Of what this bay draws; equal for copies.
};

// A wall in its own frame: x along it to the right as seen from outside, y into the building,
// z up, origin at the lower left corner.
struct WallPlan {
  Rigid3 world_from_wall;
  double width_m = 0.0;
  bool is_main = false;
  std::vector<double> bay_edges_m;            // Ascending; none where the wall is too short.
  std::vector<std::vector<BayPlan>> storeys;  // [storey][bay]; none where there are no edges.
  std::vector<double> downpipes_m;            // Their x.
};

// Where everything goes; no geometry yet.
struct FacadePlan {
  FacadeOptions options;
  std::vector<StoreyStyle> styles;  // Per storey.
  std::vector<double> floors_m;     // Of each storey, and the foot of the entablature.
  std::vector<WallPlan> walls;      // Front, right, back, left.
};

// Requires usable options.
FacadePlan PlanFacade(const FacadeOptions& options);

// How many bays a wall of that width has; they fill it between the corner margins.
int NumBays(const FacadeOptions& options, double width_m);
// Height of a storey above the ground storey.
double StoreyHeight(const FacadeOptions& options);
// Side of a control point's plate.
double TargetSide(const FacadeOptions& options);

}  // namespace plumb
