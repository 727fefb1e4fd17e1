// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The roof's edge: gutter, rows of tiles, chimneys; and the downpipes.
#include <algorithm>
#include <cmath>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kPitch_rad = 38.0 / 180.0 * kPi;
constexpr double kTileRow_m = 0.3;  // Girth of a row: its slope and its riser.
constexpr double kTileRiser_m = 0.02;
constexpr double kMaxRun_m = 5.0;  // Level depth of the tiled strip.
constexpr double kGutterRadius_m = 0.08;
constexpr double kPipeRadius_m = 0.05;
constexpr double kPipeGap_m = 0.17;  // From the wall to the pipe's axis: clear of string courses.
constexpr double kClampSpacing_m = 2.0;
constexpr std::uint64_t kChimneyKey = 303;

std::vector<Vector2d> Rectangle(const FacadeOptions& options, double margin_m) {
  return {{-margin_m, -margin_m},
          {options.width_m + margin_m, -margin_m},
          {options.width_m + margin_m, options.depth_m + margin_m},
          {-margin_m, options.depth_m + margin_m}};
}

// A half round channel of sheet metal, hung from the roof's edge.
Profile GutterProfile() {
  Profile profile;
  for (int k = 0; k <= 8; ++k) {  // The outside, from the back over the bottom to the lip.
    const double angle = kPi * (1.0 + k / 8.0);
    profile.emplace_back(kGutterRadius_m * std::sin(angle), kGutterRadius_m * std::cos(angle));
  }
  for (int k = 8; k >= 0; --k) {
    const double angle = kPi * (1.0 + k / 8.0);
    const double radius_m = kGutterRadius_m - 0.004;
    profile.emplace_back(radius_m * std::sin(angle), radius_m * std::cos(angle));
  }
  profile.push_back(profile.front());
  return profile;
}

// Rows of tiles, each with its lower edge standing out of the row below.
Profile TileProfile(double run_m) {
  const double slope_m = kTileRow_m - kTileRiser_m;
  const double rise_m = slope_m * std::sin(kPitch_rad);
  const double back_m = slope_m * std::cos(kPitch_rad);
  Profile profile = {{0.0, 0.0}};
  const auto rows = static_cast<int>(std::floor(run_m / back_m));
  double across = 0.0;
  double out = 0.0;
  for (int row = 0; row < rows; ++row) {
    across += kTileRiser_m;
    profile.emplace_back(across, out);
    across += rise_m;
    out -= back_m;
    profile.emplace_back(across, out);
  }
  return profile;
}

void AddChimneys(const Site& site, double top_m, double inset_m) {
  const FacadeOptions& options = site.plan.options;
  RandomNumbers random(DeriveSeed(options.seed, kChimneyKey, 0));
  const int count = std::max(1, static_cast<int>(options.width_m / 12.0));
  for (int k = 0; k < count; ++k) {
    const double x = options.width_m * (k + random.Uniform(0.35, 0.65)) / count;
    const double y = inset_m + random.Uniform(0.2, 0.6);
    const double wide_m = random.Uniform(0.5, 1.1);
    const double high_m = top_m + random.Uniform(0.8, 1.5);
    AddBox(site.builder,
           {x - wide_m, y - 0.35, top_m - 2.0},
           {x + wide_m, y + 0.35, high_m},
           site.palette.brick,
           {true, true, true, false, true});
    AddBox(site.builder,
           {x - wide_m - 0.07, y - 0.42, high_m},
           {x + wide_m + 0.07, y + 0.42, high_m + 0.12},
           site.palette.kerb,
           {true, true, true, true, true});
  }
}

void AddClamp(const Site& site, double x, double z) {
  const std::vector<Vector2d> outline = {{kPipeRadius_m - 0.002, -0.02},
                                         {kPipeRadius_m + 0.008, -0.02},
                                         {kPipeRadius_m + 0.008, 0.02},
                                         {kPipeRadius_m - 0.002, 0.02}};
  AddRevolution(site.builder, outline, {x, -kPipeGap_m, z}, 16, site.palette.zinc);
  AddBox(site.builder,
         {x - 0.012, -kPipeGap_m + kPipeRadius_m, z - 0.012},
         {x + 0.012, kEmbedded_m, z + 0.012},
         site.palette.zinc,
         {false, false, true, true, true});
}

void AddDownpipe(const Site& site, double x) {
  const double head = site.plan.options.height_m - kEntablature_m;
  AddTube(site.builder,
          {{x, -kPipeGap_m, 0.18}, {x, -kPipeGap_m, head}},
          kPipeRadius_m,
          16,
          site.palette.zinc);
  // The shoe at the foot and the hopper under the cornice.
  AddTube(site.builder,
          {{x, -kPipeGap_m, 0.2}, {x, -kPipeGap_m - 0.02, 0.12}, {x, -kPipeGap_m - 0.16, 0.04}},
          kPipeRadius_m,
          16,
          site.palette.zinc);
  AddRevolution(site.builder,
                {{0.0, 0.0}, {0.055, 0.0}, {0.12, 0.16}, {0.12, 0.3}, {0.0, 0.3}},
                {x, -kPipeGap_m, head - 0.12},
                16,
                site.palette.zinc);
  for (double z = 1.6; z < head - 0.5; z += kClampSpacing_m) AddClamp(site, x, z);
}

}  // namespace

double RoofSlope() {
  const double slope_m = kTileRow_m - kTileRiser_m;
  return (slope_m * std::sin(kPitch_rad) + kTileRiser_m) / (slope_m * std::cos(kPitch_rad));
}

void BuildDownpipes(const Site& site, const WallPlan& wall) {
  for (const double x : wall.downpipes_m) AddDownpipe(site, x);
}

void BuildRoof(const Site& site) {
  const FacadeOptions& options = site.plan.options;
  const double out_m = options.cornice_out_m;
  const double run_m =
      std::min(kMaxRun_m, 0.45 * std::min(options.width_m, options.depth_m) + out_m);
  const Profile tiles = TileProfile(run_m);
  const auto eaves = LevelPath(Rectangle(options, out_m), options.height_m, /*is_loop=*/true);
  AddSweep(site.builder, tiles, eaves, site.palette.roof_tiles, SweepEnds::kLoop);
  const double top_m = options.height_m + tiles.back().x();
  std::vector<Vector3d> flat;
  for (const Vector2d& corner : Rectangle(options, out_m + tiles.back().y())) {
    flat.emplace_back(corner.x(), corner.y(), top_m);
  }
  site.builder.AddPolygon(flat, site.palette.zinc);
  const auto gutter = LevelPath(Rectangle(options, out_m + kGutterRadius_m - 0.005),
                                options.height_m + 0.01,
                                /*is_loop=*/true);
  AddSweep(site.builder, GutterProfile(), gutter, site.palette.zinc, SweepEnds::kLoop);
  AddChimneys(site, top_m, -(out_m + tiles.back().y()));
}

}  // namespace plumb
