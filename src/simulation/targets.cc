// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where control point plates hang: free places of the walls, in staggered rows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulation/facade_elements.h"

namespace plumb {
namespace {

constexpr double kClearance_m = 0.06;  // From a plate's edge to what stands out of the wall.
constexpr double kMount_m = 0.006;     // From the surface that carries a plate to its picture.
constexpr double kGrid_m = 0.1;
constexpr double kLowest_m = 1.6;  // A surveyor keeps plates off the plinth and off passers-by.
constexpr double kCornerClearance_m = 0.65;  // The quoins.

WallRect Around(double x0, double z0, double x1, double z1, double margin_m) {
  return MakeRect(x0 - margin_m, z0 - margin_m, x1 + margin_m, z1 + margin_m);
}

// All that belongs to a bay's opening.
WallRect DressOf(const BayPlan& bay) {
  const WallRect& opening = bay.opening;
  double side_m = bay.style.look.surround_width_m + 0.12;
  if (HasShutters(bay)) side_m += 0.5 * opening.sizes().x() + 0.02;
  if (bay.kind == BayKind::kBalcony) side_m = std::max(side_m, 0.9);
  if (bay.kind == BayKind::kDoor) side_m = 0.8;
  const double below_m = bay.kind == BayKind::kBalcony ? 0.85 : 0.1;
  const bool has_pediment = bay.hood == HoodKind::kTriangular || bay.hood == HoodKind::kSegmental;
  double above_m = bay.hood == HoodKind::kNone ? 0.45 : 0.6;
  if (has_pediment || bay.kind == BayKind::kDoor) above_m = bay.cell.max().y() - opening.max().y();
  return MakeRect(opening.min().x() - side_m,
                  opening.min().y() - below_m,
                  opening.max().x() + side_m,
                  opening.max().y() + above_m);
}

bool IsFree(const std::vector<WallRect>& obstacles, const WallRect& place) {
  return std::none_of(obstacles.begin(), obstacles.end(), [&](const WallRect& obstacle) {
    return obstacle.intersects(place);
  });
}

// Free centres of plates on a wall.
std::vector<Eigen::Vector2d> FreePlaces(const FacadePlan& plan, const WallPlan& wall) {
  const std::vector<WallRect> obstacles = Obstacles(plan, wall);
  const double half = 0.5 * TargetSide(plan.options);
  std::vector<Eigen::Vector2d> places;
  for (double x = kCornerClearance_m + half; x <= wall.width_m - kCornerClearance_m - half;
       x += kGrid_m) {
    for (double z = kLowest_m + half; z <= plan.floors_m.back() - half; z += kGrid_m) {
      const WallRect plate = Around(x - half, z - half, x + half, z + half, kClearance_m);
      if (IsFree(obstacles, plate)) places.emplace_back(x, z);
    }
  }
  return places;
}

// Centres of a staggered pattern of `count` places: rows of equal spacing, by turns one more.
std::vector<Eigen::Vector2d> StaggeredPattern(const WallPlan& wall, double height_m, int count) {
  const int rows = std::max(
      1, static_cast<int>(std::lround(std::sqrt(count * height_m / std::max(wall.width_m, 1.0)))));
  std::vector<Eigen::Vector2d> pattern;
  for (int row = 0; row < rows; ++row) {
    const int begin = (row * count + rows / 2) / rows;
    const int end = ((row + 1) * count + rows / 2) / rows;
    for (int k = begin; k < end; ++k) {
      pattern.emplace_back(wall.width_m * (k - begin + 0.5) / (end - begin),
                           kLowest_m + (height_m - kLowest_m) * (row + 0.5) / rows);
    }
  }
  // Out to the edges: what lies beyond the last control point is only extrapolated.
  const Eigen::Vector2d middle(0.5 * wall.width_m, 0.5 * (kLowest_m + height_m));
  for (Eigen::Vector2d& place : pattern) {
    place = middle + (place - middle).cwiseProduct(Eigen::Vector2d(1.15, 1.4));
  }
  return pattern;
}

std::vector<Eigen::Vector2d> ChoosePlaces(const FacadePlan& plan, const WallPlan& wall, int count) {
  std::vector<Eigen::Vector2d> free = FreePlaces(plan, wall);
  const double apart_m = 2.0 * TargetSide(plan.options);
  std::vector<Eigen::Vector2d> chosen;
  for (const Eigen::Vector2d& wanted : StaggeredPattern(wall, plan.floors_m.back(), count)) {
    const auto nearest =
        std::min_element(free.begin(), free.end(), [&](const auto& a, const auto& b) {
          return (a - wanted).squaredNorm() < (b - wanted).squaredNorm();
        });
    if (nearest == free.end()) {
      throw std::invalid_argument("facade: num_targets: the walls have room for fewer plates of " +
                                  std::to_string(TargetSide(plan.options)) +
                                  " m; ask for fewer or smaller ones, or fewer ornaments");
    }
    chosen.push_back(*nearest);
    const Eigen::Vector2d taken = *nearest;
    free.erase(std::remove_if(free.begin(),
                              free.end(),
                              [&](const Eigen::Vector2d& place) {
                                return (place - taken).cwiseAbs().maxCoeff() < apart_m;
                              }),
               free.end());
  }
  return chosen;
}

Plate MakePlate(const FacadePlan& plan, const WallPlan& wall, const Eigen::Vector2d& place) {
  // On the ground storey the plates hang on the rusticated blocks.
  const bool is_on_blocks = plan.styles[0].wall == WallKind::kRusticated &&
                            place.y() - TargetSide(plan.options) < plan.floors_m[1];
  const double y_m = -kMount_m - (is_on_blocks ? kRustication_m : 0.0);
  Eigen::Matrix3d wall_from_plate;  // Columns: right, down, into the wall.
  wall_from_plate << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  Plate plate;
  plate.side_m = TargetSide(plan.options);
  plate.world_from_plate = wall.world_from_wall *
                           Rigid3(Eigen::Quaterniond(wall_from_plate), {place.x(), y_m, place.y()});
  return plate;
}

}  // namespace

std::vector<WallRect> Obstacles(const FacadePlan& plan, const WallPlan& wall) {
  std::vector<WallRect> obstacles;
  for (std::size_t storey = 0; storey < wall.storeys.size(); ++storey) {
    const double floor = plan.floors_m[storey];
    const double course_m = std::max(0.02, plan.styles[storey].course_height_m);
    obstacles.push_back(MakeRect(0.0, floor - 0.02, wall.width_m, floor + course_m));
    for (const BayPlan& bay : wall.storeys[storey]) {
      if (bay.kind != BayKind::kBlank) obstacles.push_back(DressOf(bay));
    }
  }
  for (const double x : wall.downpipes_m) {
    obstacles.push_back(MakeRect(x - 0.2, 0.0, x + 0.2, plan.options.height_m));
  }
  return obstacles;
}

std::vector<Plate> PlaceTargets(const FacadePlan& plan) {
  std::vector<const WallPlan*> walls;
  double length_m = 0.0;
  for (const WallPlan& wall : plan.walls) {
    if (!wall.is_main && !plan.options.closed) continue;
    walls.push_back(&wall);
    length_m += wall.width_m;
  }
  std::vector<Plate> plates;
  double passed_m = 0.0;
  for (const WallPlan* wall : walls) {
    passed_m += wall->width_m;
    const auto until =
        static_cast<std::size_t>(std::lround(plan.options.num_targets * passed_m / length_m));
    const auto count = static_cast<int>(until - plates.size());
    for (const Eigen::Vector2d& place : ChoosePlaces(plan, *wall, count)) {
      plates.push_back(MakePlate(plan, *wall, place));
      plates.back().id = static_cast<int>(plates.size()) - 1;
    }
  }
  return plates;
}

}  // namespace plumb
