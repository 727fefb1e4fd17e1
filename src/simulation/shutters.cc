// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Louvred shutters, open against the wall.
#include <cmath>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr double kCore_m = 0.018;
constexpr double kRim_m = 0.014;  // How far frame and slats stand before the core.
constexpr double kRimWidth_m = 0.06;
constexpr double kSlat_m = 0.045;
constexpr double kWallGap_m = 0.05;
constexpr std::uint64_t kShutterKey = 302;

void AddSlats(const Site& site, double x0, double x1, double z0, double z1) {
  const auto count = FittedCount(z1 - z0, kSlat_m);
  const double step_m = (z1 - z0) / count;
  const double back = -kCore_m;
  const double front = -kCore_m - 0.8 * kRim_m;
  for (int k = 0; k < count; ++k) {
    const double low = z0 + k * step_m;
    const double lip = low + 0.006;
    const double high = low + step_m;
    site.builder.AddPolygon({{x0, back, low}, {x1, back, low}, {x1, front, low}, {x0, front, low}},
                            site.palette.shutter);
    site.builder.AddPolygon(
        {{x0, front, low}, {x1, front, low}, {x1, front, lip}, {x0, front, lip}},
        site.palette.shutter);
    site.builder.AddPolygon(
        {{x0, front, lip}, {x1, front, lip}, {x1, back, high}, {x0, back, high}},
        site.palette.shutter);
  }
}

// A leaf from x = 0 to x = width (negative: to the left), hung in the frame's origin.
void AddLeaf(const Site& site, double width_m, double height_m) {
  const double x0 = std::min(0.0, width_m);
  const double x1 = std::max(0.0, width_m);
  AddBox(site.builder,
         {x0, -kCore_m, 0.0},
         {x1, 0.0, height_m},
         site.palette.shutter,
         {true, true, true, true, true});
  const auto rim = WallPath({{x0, 0.0}, {x1, 0.0}, {x1, height_m}, {x0, height_m}},
                            -kCore_m - kRim_m,
                            /*is_loop=*/true);
  AddSweep(site.builder,
           FrameProfile(kRimWidth_m, kRim_m + 0.002),
           rim,
           site.palette.shutter,
           SweepEnds::kLoop);
  const double middle = 0.45 * height_m;
  AddBlock(site.builder,
           {x0 + kRimWidth_m, -kCore_m - kRim_m, middle - 0.04},
           {x1 - kRimWidth_m, -kCore_m + 0.002, middle + 0.04},
           0.004,
           site.palette.shutter);
  AddSlats(site, x0 + kRimWidth_m, x1 - kRimWidth_m, kRimWidth_m, middle - 0.04);
  AddSlats(site, x0 + kRimWidth_m, x1 - kRimWidth_m, middle + 0.04, height_m - kRimWidth_m);
}

}  // namespace

void BuildShutters(const Site& site, const BayPlan& bay) {
  RandomNumbers random(DeriveSeed(site.plan.options.seed, kShutterKey, bay.random_key));
  const double half = 0.5 * bay.opening.sizes().x();
  const double hinge = half + bay.style.look.surround_width_m + 0.01;
  for (const double side : {-1.0, 1.0}) {
    // Never quite against the wall.
    const double angle = random.Chance(0.2) ? random.Uniform(0.2, 0.6) : random.Uniform(0.0, 0.05);
    const Eigen::AngleAxisd turn(-side * angle, Eigen::Vector3d::UnitZ());
    const FrameScope frame(site.builder,
                           Rigid3(Eigen::Quaterniond(turn), {side * hinge, -kWallGap_m, 0.01}));
    AddLeaf(site, side * (half - 0.005), bay.opening.sizes().y() - 0.02);
  }
}

}  // namespace plumb
