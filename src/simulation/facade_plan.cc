// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/facade_plan.h"

#include <algorithm>
#include <cmath>

#include "plumbline/marker/marker_layout.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGroundStoreyShare = 1.1;  // Higher than the others.
constexpr double kSillShare = 0.42;         // Of the height that the window leaves.
constexpr double kBalconyThreshold_m = 0.12;
constexpr double kBaySlack = 0.1;     // Bays may be narrower than asked by less than a tenth.
constexpr int kPlainWindowEvery = 4;  // A plain storey has few windows.
constexpr std::uint64_t kKindKey = 201;
constexpr std::uint64_t kStoreyKey = 202;
constexpr std::uint64_t kCopyKey = 203;
constexpr std::uint64_t kFirstCopyKey = 1000000000;  // Beyond the keys of the unique bays.

// With repetition, storeys take the look of the first upper storey.
std::vector<StoreyStyle> RepeatStyles(const FacadeOptions& options) {
  std::vector<StoreyStyle> styles = DrawStoreyStyles(options);
  for (std::size_t storey = 2; storey < styles.size(); ++storey) {
    RandomNumbers random(DeriveSeed(options.seed, kStoreyKey, storey));
    const bool is_plain = styles[storey].wall == WallKind::kPlain;
    if (!is_plain && random.Chance(options.repetition)) styles[storey] = styles[1];
  }
  return styles;
}

std::vector<double> FloorHeights(const FacadeOptions& options) {
  const double upper_m = StoreyHeight(options);
  std::vector<double> floors = {options.plinth_height_m};
  floors.push_back(floors.back() + kGroundStoreyShare * upper_m);
  for (int storey = 1; storey < options.num_storeys; ++storey) {
    floors.push_back(floors.back() + upper_m);
  }
  return floors;
}

bool IsDoor(const FacadeOptions& options, int bay, int num_bays) {
  for (int door = 0; door < options.num_doors; ++door) {
    if (bay == (2 * door + 1) * num_bays / (2 * options.num_doors)) return true;
  }
  return false;
}

WallRect OpeningOf(const FacadeOptions& options, const BayPlan& bay) {
  const double middle = bay.cell.center().x();
  const double half = 0.5 * options.window_width_m;
  const double floor = bay.cell.min().y();
  const double sill = floor + kSillShare * (bay.cell.sizes().y() - options.window_height_m);
  const double head = sill + options.window_height_m;
  if (bay.kind == BayKind::kDoor) {
    return MakeRect(middle - 1.25 * half, kThreshold_m, middle + 1.25 * half, head + 0.1);
  }
  if (bay.kind == BayKind::kBalcony) {
    return MakeRect(middle - half, floor + kBalconyThreshold_m, middle + half, head);
  }
  return MakeRect(middle - half, sill, middle + half, head);
}

BayKind DrawKind(
    const FacadeOptions& options, const WallPlan& wall, int storey, int bay, std::uint64_t key) {
  RandomNumbers random(DeriveSeed(options.seed, kKindKey, key));
  const auto num_bays = static_cast<int>(wall.bay_edges_m.size()) - 1;
  if (storey == 0 && wall.is_main && IsDoor(options, bay, num_bays)) return BayKind::kDoor;
  if (storey > 0 && random.Chance(options.balcony_share)) return BayKind::kBalcony;
  return BayKind::kWindow;
}

BayPlan PlanBay(const FacadePlan& plan, const WallPlan& wall, std::size_t storey, std::size_t bay) {
  const FacadeOptions& options = plan.options;
  const StoreyStyle& style = plan.styles[storey];
  BayPlan result;
  result.style = style;
  result.cell = MakeRect(wall.bay_edges_m[bay],
                         plan.floors_m[storey],
                         wall.bay_edges_m[bay + 1],
                         plan.floors_m[storey + 1]);
  result.random_key = ((plan.walls.size() * 1000) + storey) * 1000 + bay;
  if (!wall.is_main && !options.closed) {
    result.kind = BayKind::kBlank;
  } else if (style.wall == WallKind::kPlain) {
    if (bay % kPlainWindowEvery == 1) result.kind = BayKind::kWindow;
  } else {
    result.kind =
        DrawKind(options, wall, static_cast<int>(storey), static_cast<int>(bay), result.random_key);
  }
  if (result.kind != BayKind::kBlank) result.opening = OpeningOf(options, result);
  RandomNumbers random(DeriveSeed(options.seed, kCopyKey, result.random_key));
  const bool is_copy = random.Chance(options.repetition);
  const bool alternates = !is_copy && bay % 2 == 1;
  result.hood = alternates ? style.look.alternate_hood : style.look.hood;
  if (is_copy) {
    result.copy_key = std::to_string(style.id) + '/' +
                      std::to_string(static_cast<int>(result.kind)) + '/' +
                      std::to_string(static_cast<int>(result.hood)) + '/' +
                      std::to_string(std::lround(1e4 * result.cell.sizes().x()));
    result.random_key = kFirstCopyKey + static_cast<std::uint64_t>(style.id);
  }
  return result;
}

void PlanBays(FacadePlan& plan, WallPlan& wall) {
  const int num_bays = NumBays(plan.options, wall.width_m);
  if (num_bays == 0) return;
  const double width_m = (wall.width_m - 2.0 * kCornerMargin_m) / num_bays;
  for (int edge = 0; edge <= num_bays; ++edge) {
    wall.bay_edges_m.push_back(kCornerMargin_m + edge * width_m);
  }
  for (std::size_t storey = 0; storey < plan.styles.size(); ++storey) {
    std::vector<BayPlan> bays;
    for (int bay = 0; bay < num_bays; ++bay) {
      bays.push_back(PlanBay(plan, wall, storey, static_cast<std::size_t>(bay)));
    }
    wall.storeys.push_back(std::move(bays));
  }
}

void PlanDownpipes(const FacadeOptions& options, WallPlan& wall) {
  const auto last_edge = static_cast<int>(wall.bay_edges_m.size()) - 1;
  const int count = std::min(options.num_downpipes, last_edge + 1);
  for (int pipe = 0; pipe < count; ++pipe) {
    const int edge = count == 1 ? 0 : (2 * pipe * last_edge + count - 1) / (2 * (count - 1));
    wall.downpipes_m.push_back(wall.bay_edges_m[static_cast<std::size_t>(edge)]);
  }
}

}  // namespace

double StoreyHeight(const FacadeOptions& options) {
  return (options.height_m - options.plinth_height_m - kEntablature_m) /
         (options.num_storeys - 1 + kGroundStoreyShare);
}

double TargetSide(const FacadeOptions& options) {
  return kSidePerDiameter * options.target_diameter_m;
}

int NumBays(const FacadeOptions& options, double width_m) {
  const double room_m = width_m - 2.0 * kCornerMargin_m;
  return static_cast<int>(std::floor(std::max(0.0, room_m / options.bay_width_m + kBaySlack)));
}

FacadePlan PlanFacade(const FacadeOptions& options) {
  FacadePlan plan;
  plan.options = options;
  plan.styles = RepeatStyles(options);
  plan.floors_m = FloorHeights(options);
  const std::array<Eigen::Vector3d, 4> corners = {
      Eigen::Vector3d(0.0, 0.0, 0.0),
      Eigen::Vector3d(options.width_m, 0.0, 0.0),
      Eigen::Vector3d(options.width_m, options.depth_m, 0.0),
      Eigen::Vector3d(0.0, options.depth_m, 0.0)};
  for (std::size_t side = 0; side < 4; ++side) {
    WallPlan wall;
    const Eigen::AngleAxisd turn(0.5 * kPi * static_cast<double>(side), Eigen::Vector3d::UnitZ());
    wall.world_from_wall = Rigid3(Eigen::Quaterniond(turn), corners[side]);
    wall.width_m = side % 2 == 0 ? options.width_m : options.depth_m;
    wall.is_main = side == 0;
    PlanBays(plan, wall);
    if (wall.is_main || options.closed) PlanDownpipes(options, wall);
    plan.walls.push_back(std::move(wall));
  }
  return plan;
}

}  // namespace plumb
