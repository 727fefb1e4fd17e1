// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Balconies: slab, brackets, and a railing of iron or of stone balusters.
#include <algorithm>
#include <cmath>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"

namespace plumb {
namespace {

using Eigen::Vector3d;

constexpr double kDepth_m = 1.0;
constexpr double kSlab_m = 0.2;
constexpr double kSlabLip_m = 0.05;
constexpr double kRailHeight_m = 0.95;
constexpr double kIronBarSpacing_m = 0.11;
constexpr double kBalusterSpacing_m = 0.2;
constexpr double kPost_m = 0.17;

// The railing's line: three straight runs seen from above.
struct Run {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

std::vector<Run> RailRuns(double half_m, double inset_m) {
  const double x = half_m - inset_m;
  const double y = -kDepth_m + inset_m;
  return {{{-x, -0.02}, {-x, y}}, {{-x, y}, {x, y}}, {{x, y}, {x, -0.02}}};
}

void AddSlab(const Site& site, double half_m) {
  const Profile edge = {{0.0, 0.0},
                        {0.06, 0.0},
                        {0.06, 0.015},
                        {0.1, 0.02},
                        {0.13, 0.04},
                        {0.14, kSlabLip_m},
                        {kSlab_m, kSlabLip_m}};
  const double foot = -0.02 - kSlab_m;
  const auto path = LevelPath(
      {{-half_m, kEmbedded_m}, {-half_m, -kDepth_m}, {half_m, -kDepth_m}, {half_m, kEmbedded_m}},
      foot);
  AddSweep(site.builder, edge, path, site.palette.trim, SweepEnds::kOpen);
  const auto add_level = [&](double z, double lip_m, bool is_top) {
    std::vector<Vector3d> corners = {{-half_m - lip_m, kEmbedded_m, z},
                                     {-half_m - lip_m, -kDepth_m - lip_m, z},
                                     {half_m + lip_m, -kDepth_m - lip_m, z},
                                     {half_m + lip_m, kEmbedded_m, z}};
    if (!is_top) std::reverse(corners.begin(), corners.end());
    site.builder.AddPolygon(corners, site.palette.trim);
  };
  add_level(foot, 0.0, false);
  add_level(foot + kSlab_m, kSlabLip_m, true);
  for (const double x : {-half_m + 0.25, half_m - 0.25}) {
    AddMoulding(
        site.builder, BracketProfile(0.55, 0.8), x - 0.1, x + 0.1, foot - 0.55, site.palette.trim);
  }
}

void AddIronRun(const Site& site, const Run& run) {
  const Eigen::Vector2d along = run.to - run.from;
  const auto count = FittedCount(along.norm(), kIronBarSpacing_m);
  const auto at = [&](double share, double z) {
    const Eigen::Vector2d point = run.from + share * along;
    return Vector3d(point.x(), point.y(), z);
  };
  for (int bar = 0; bar <= count; ++bar) {
    const double share = static_cast<double>(bar) / count;
    const bool is_end = bar == 0 || bar == count;
    const double low = is_end ? -0.03 : 0.08;
    AddTube(site.builder,
            {at(share, low), at(share, kRailHeight_m)},
            is_end ? 0.014 : 0.008,
            8,
            site.palette.iron);
  }
  for (const double z : {0.08, 0.8, kRailHeight_m}) {
    const double radius_m = z == kRailHeight_m ? 0.024 : 0.011;
    AddTube(site.builder, {at(0.0, z), at(1.0, z)}, radius_m, 8, site.palette.iron);
  }
}

std::vector<Eigen::Vector2d> BalusterOutline(double height_m) {
  const std::vector<Eigen::Vector2d> shares = {{0.062, 0.0},
                                               {0.062, 0.06},
                                               {0.04, 0.08},
                                               {0.036, 0.12},
                                               {0.052, 0.2},
                                               {0.063, 0.3},
                                               {0.06, 0.4},
                                               {0.045, 0.55},
                                               {0.032, 0.7},
                                               {0.029, 0.8},
                                               {0.044, 0.84},
                                               {0.044, 0.88},
                                               {0.034, 0.9},
                                               {0.058, 0.94},
                                               {0.058, 1.0}};
  std::vector<Eigen::Vector2d> outline;
  for (const Eigen::Vector2d& share : shares) outline.emplace_back(share.x(), share.y() * height_m);
  return outline;
}

void AddStoneRun(const Site& site, const Run& run) {
  const Eigen::Vector2d along = run.to - run.from;
  const double length_m = along.norm();
  const double foot = 0.06;
  const double top = kRailHeight_m - 0.14;
  const auto count = FittedCount(length_m - kPost_m, kBalusterSpacing_m);
  for (int k = 0; k < count; ++k) {
    const double share = (0.5 * kPost_m + (k + 0.5) * (length_m - kPost_m) / count) / length_m;
    const Eigen::Vector2d point = run.from + share * along;
    AddRevolution(site.builder,
                  BalusterOutline(top - foot),
                  {point.x(), point.y(), foot},
                  12,
                  site.palette.trim);
  }
  const Eigen::Vector2d half(0.07, 0.07);
  const Eigen::Vector2d low = run.from.cwiseMin(run.to) - half;
  const Eigen::Vector2d high = run.from.cwiseMax(run.to) + half;
  const BoxFaces all{true, true, true, true, true};
  AddBox(
      site.builder, {low.x(), low.y(), -0.03}, {high.x(), high.y(), foot}, site.palette.trim, all);
  AddBox(site.builder,
         {low.x() - 0.02, low.y() - 0.02, top},
         {high.x() + 0.02, high.y() + 0.02, kRailHeight_m},
         site.palette.trim,
         all);
}

void AddPosts(const Site& site, const std::vector<Run>& runs) {
  for (const Eigen::Vector2d& point : {runs[1].from, runs[1].to}) {
    AddBox(site.builder,
           {point.x() - 0.5 * kPost_m, point.y() - 0.5 * kPost_m, -0.03},
           {point.x() + 0.5 * kPost_m, point.y() + 0.5 * kPost_m, kRailHeight_m + 0.03},
           site.palette.trim,
           {true, true, true, false, true});
  }
}

}  // namespace

void BuildBalcony(const Site& site, const BayPlan& bay) {
  const double half_m =
      std::min(0.5 * bay.opening.sizes().x() + 0.6, 0.5 * bay.cell.sizes().x() - 0.15);
  AddSlab(site, half_m);
  const bool is_stone = bay.style.id % 2 == 1;
  const std::vector<Run> runs = RailRuns(half_m, is_stone ? 0.09 : 0.05);
  for (const Run& run : runs) {
    if (is_stone) {
      AddStoneRun(site, run);
    } else {
      AddIronRun(site, run);
    }
  }
  if (is_stone) AddPosts(site, runs);
}

}  // namespace plumb
