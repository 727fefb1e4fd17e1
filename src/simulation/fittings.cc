// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Small things on the wall: cellar grilles, lamps, house numbers, vents, flower boxes.
#include "simulation/facade_elements.h"
#include "simulation/profiles.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr std::uint64_t kFittingKey = 304;
constexpr double kFlowerShare = 0.18;
constexpr double kVentShare = 0.3;
constexpr double kPlinthFace_m = -0.08;

// An iron grille before a cellar opening in the plinth, its foot at height z.
void AddCellarGrille(const Site& site, double half_m, double z, double height_m) {
  AddBlock(site.builder,
           {-half_m - 0.07, kPlinthFace_m - 0.025, z - 0.07},
           {half_m + 0.07, 0.0, z + height_m + 0.07},
           0.01,
           site.palette.kerb);
  site.builder.AddPolygon({{-half_m, kPlinthFace_m - 0.027, z},
                           {half_m, kPlinthFace_m - 0.027, z},
                           {half_m, kPlinthFace_m - 0.027, z + height_m},
                           {-half_m, kPlinthFace_m - 0.027, z + height_m}},
                          site.palette.panes[0]);
  const double y = kPlinthFace_m - 0.042;
  constexpr int kNumBars = 7;
  for (int bar = 0; bar < kNumBars; ++bar) {
    const double x = half_m * (2.0 * bar / (kNumBars - 1) - 1.0);
    AddTube(
        site.builder, {{x, y, z - 0.04}, {x, y, z + height_m + 0.04}}, 0.009, 8, site.palette.iron);
  }
  for (const double share : {0.15, 0.85}) {
    const double level = z + share * height_m;
    AddTube(site.builder,
            {{-half_m - 0.05, y, level}, {half_m + 0.05, y, level}},
            0.011,
            8,
            site.palette.iron);
  }
}

// A lantern on a bent arm.
void AddLamp(const Site& site, double x, double z) {
  AddTube(site.builder,
          {{x, 0.0, z}, {x, -0.16, z + 0.06}, {x, -0.26, z + 0.02}, {x, -0.28, z - 0.06}},
          0.014,
          10,
          site.palette.iron);
  AddRevolution(site.builder,
                {{0.0, 0.3}, {0.07, 0.3}, {0.1, 0.36}, {0.0, 0.36}},
                {x, -0.28, z - 0.75},
                8,
                site.palette.iron);
  AddRevolution(
      site.builder, {{0.065, 0.34}, {0.1, 0.6}}, {x, -0.28, z - 0.75}, 8, site.palette.panes[2]);
  AddRevolution(site.builder,
                {{0.0, 0.59}, {0.125, 0.59}, {0.11, 0.62}, {0.03, 0.7}, {0.0, 0.7}},
                {x, -0.28, z - 0.75},
                8,
                site.palette.iron);
}

void AddHouseNumber(const Site& site, double x, double z) {
  AddBlock(site.builder,
           {x - 0.11, -kRustication_m - 0.012, z},
           {x + 0.11, 0.0, z + 0.17},
           0.004,
           site.palette.iron);
  AddBlock(site.builder,
           {x - 0.04, -kRustication_m - 0.016, z + 0.03},
           {x + 0.045, 0.0, z + 0.14},
           0.002,
           site.palette.frame);
}

void AddVent(const Site& site, double x, double z) {
  AddBlock(
      site.builder, {x - 0.08, -0.012, z}, {x + 0.08, 0.0, z + 0.16}, 0.006, site.palette.zinc);
  for (int slot = 0; slot < 5; ++slot) {
    const double low = z + 0.02 + 0.025 * slot;
    AddBlock(site.builder,
             {x - 0.065, -0.02, low},
             {x + 0.065, 0.0, low + 0.015},
             0.006,
             site.palette.zinc);
  }
}

void AddFlowerBox(const Site& site, double half_m, RandomNumbers& random) {
  AddBox(site.builder,
         {-half_m, -0.2, 0.02},
         {half_m, -0.03, 0.2},
         site.palette.door,
         {true, true, true, true, true});
  const int count = FittedCount(2.0 * half_m, 0.11);
  for (int k = 0; k < count; ++k) {
    const double x = half_m * (2.0 * (k + random.Uniform(0.3, 0.7)) / count - 1.0);
    const double radius_m = random.Uniform(0.05, 0.09);
    const double top = random.Uniform(0.1, 0.22);
    AddRevolution(site.builder,
                  {{0.03, 0.0}, {radius_m, 0.4 * top}, {0.8 * radius_m, 0.8 * top}, {0.0, top}},
                  {x, random.Uniform(-0.15, -0.09), 0.19},
                  7,
                  site.palette.grass);
  }
}

void AddDoorFittings(const Site& site, const BayPlan& bay) {
  const double beside = 0.5 * bay.opening.sizes().x() + 0.55;
  const double head = bay.opening.sizes().y();
  for (const double side : {-1.0, 1.0}) AddLamp(site, side * beside, 0.8 * head);
  AddHouseNumber(site, beside, 0.4 * head);
}

}  // namespace

void BuildFittings(const Site& site, const BayPlan& bay) {
  RandomNumbers random(DeriveSeed(site.plan.options.seed, kFittingKey, bay.random_key));
  if (bay.style.wall == WallKind::kPlain) return;
  if (bay.kind == BayKind::kDoor) {
    AddDoorFittings(site, bay);
    return;
  }
  const double half = 0.5 * bay.opening.sizes().x();
  if (bay.style.wall == WallKind::kRusticated) {
    const double plinth = site.plan.options.plinth_height_m;
    if (plinth > 0.9) AddCellarGrille(site, 0.32, 0.4 - bay.opening.min().y(), plinth - 0.75);
    return;
  }
  if (bay.kind != BayKind::kWindow) return;
  if (random.Chance(kFlowerShare)) AddFlowerBox(site, half - 0.05, random);
  if (!bay.style.look.has_apron && random.Chance(kVentShare)) {
    AddVent(site, random.Uniform(-0.3, 0.3), -0.42);
  }
}

}  // namespace plumb
