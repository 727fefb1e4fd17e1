// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Dormer windows on the roof's slope over a wall.
#include "simulation/facade_elements.h"
#include "simulation/profiles.h"

namespace plumb {
namespace {

using Eigen::Vector3d;

constexpr double kBehindEaves_m = 1.1;
constexpr double kWidth_m = 1.5;
constexpr double kHeight_m = 1.45;
constexpr double kPost_m = 0.16;
constexpr double kGable_m = 0.5;
constexpr double kOverhang_m = 0.12;
constexpr double kSheet_m = 0.05;     // Thickness of the dormer's roof.
constexpr double kMinDepth_m = 10.0;  // A shallower building has no room on its roof.

// The front's posts, sill and lintel, and the cheeks behind them.
void AddBody(const Site& site, double depth_m) {
  const double half = 0.5 * kWidth_m;
  const BoxFaces faces{true, false, true, false, false};
  for (const double x : {-half, half - kPost_m}) {
    AddBox(
        site.builder, {x, 0.0, -0.4}, {x + kPost_m, depth_m, kHeight_m}, site.palette.frame, faces);
  }
  const double inside = half - kPost_m;
  AddBox(site.builder,
         {-inside, 0.0, -0.4},
         {inside, 0.4, 0.0},
         site.palette.frame,
         {true, false, false, false, true});
  AddBox(site.builder,
         {-inside, 0.0, kHeight_m - kPost_m},
         {inside, 0.4, kHeight_m},
         site.palette.frame,
         {true, false, false, true, false});
  AddMoulding(
      site.builder, SillProfile(0.07, 0.09), -half - 0.04, half + 0.04, -0.07, site.palette.zinc);
}

// A gable and the two slopes of sheet metal over it.
void AddGableRoof(const Site& site, double depth_m) {
  const double half = 0.5 * kWidth_m;
  const double slope = kGable_m / half;
  const double eaves_x = half + kOverhang_m;
  const double eaves_z = kHeight_m - slope * kOverhang_m;
  const double front = -kOverhang_m;
  site.builder.AddPolygon(
      {{-half, 0.0, kHeight_m}, {half, 0.0, kHeight_m}, {0.0, 0.0, kHeight_m + kGable_m}},
      site.palette.frame);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d low(side * eaves_x, front, eaves_z);
    const Vector3d top(0.0, front, kHeight_m + kGable_m);
    const Vector3d back(0.0, depth_m - front, 0.0);
    const Vector3d up(0.0, 0.0, kSheet_m);
    const auto add = [&](std::vector<Vector3d> corners) {
      if (side > 0.0) std::reverse(corners.begin(), corners.end());
      site.builder.AddPolygon(corners, site.palette.zinc);
    };
    add({low + up + back, low + up, top + up, top + up + back});  // Upper side.
    add({low, low + back, top + back, top});                      // Lower side.
    add({low, top, top + up, low + up});                          // Front edge.
    add({low + back, low, low + up, low + up + back});            // Eaves.
  }
}

void AddDormer(const Site& site, std::uint64_t random_key) {
  AddBody(site, kHeight_m / RoofSlope() + 0.2);
  AddGableRoof(site, (kHeight_m + kGable_m) / RoofSlope() + 0.2);
  BayPlan window;
  window.kind = BayKind::kBalcony;  // No blind.
  const double half = 0.5 * kWidth_m - kPost_m;
  window.opening = MakeRect(-half, 0.0, half, kHeight_m - kPost_m);
  window.style.look.has_transom = false;
  window.random_key = random_key;
  BuildWindow(site, window);
}

}  // namespace

void BuildDormers(const Site& site, const WallPlan& wall) {
  const FacadeOptions& options = site.plan.options;
  if (!wall.is_main || options.depth_m < kMinDepth_m) return;
  const double y = kBehindEaves_m - options.cornice_out_m;
  const double z = options.height_m + kBehindEaves_m * RoofSlope() + 0.12;
  for (std::size_t bay = 1; bay + 2 < wall.bay_edges_m.size(); bay += 2) {
    const double x = 0.5 * (wall.bay_edges_m[bay] + wall.bay_edges_m[bay + 1]);
    const std::string& key = wall.storeys.back()[bay].copy_key;
    const CopyScope copies(site.builder, key.empty() ? "" : "dormer/" + key);
    const FrameScope frame(site.builder, {x, y, z});
    AddDormer(site, wall.storeys.back()[bay].random_key);
  }
}

}  // namespace plumb
