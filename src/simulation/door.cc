// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// House doors: steps, stone case, fanlight, two panelled leaves.
#include "simulation/facade_elements.h"
#include "simulation/profiles.h"

namespace plumb {
namespace {

constexpr double kFrameWidth_m = 0.07;
constexpr double kFanlightShare = 0.76;
constexpr double kLeafBack_m = 0.03;
constexpr double kCaseWidth_m = 0.3;
constexpr double kCaseOut_m = 0.14;
constexpr double kStepDepth_m = 0.36;

void AddSteps(const Site& site, double half_m) {
  for (int step = 0; step < 2; ++step) {
    const double top = -0.5 * kThreshold_m * step;
    const double out_m = 0.12 + kStepDepth_m * (step + 1);
    const double wide_m = half_m + 0.25 + 0.2 * step;
    AddBlock(site.builder,
             {-wide_m, -out_m, -kThreshold_m},
             {wide_m, kEmbedded_m, top},
             0.012,
             site.palette.kerb);
  }
}

void AddCase(const Site& site, double half_m, double height_m) {
  const auto path = WallPath({{-half_m, -0.5 * kThreshold_m},
                              {-half_m, height_m},
                              {half_m, height_m},
                              {half_m, -0.5 * kThreshold_m}},
                             0.0);
  AddSweep(site.builder,
           ArchitraveProfile(kCaseWidth_m, kCaseOut_m),
           path,
           site.palette.trim,
           SweepEnds::kCapped);
  const double top = height_m + kCaseWidth_m;
  AddMoulding(site.builder,
              HoodProfile(0.2, 0.32),
              -half_m - kCaseWidth_m - 0.08,
              half_m + kCaseWidth_m + 0.08,
              top,
              site.palette.trim);
  AddBlock(site.builder,
           {-0.13, -kCaseOut_m - 0.05, height_m - 0.04},
           {0.13, kEmbedded_m, top},
           0.02,
           site.palette.trim);
}

void AddFanlight(const Site& site, double half_m, double low, double high, double y_m) {
  const double pane_y = y_m + kLeafBack_m;
  site.builder.AddPolygon({{-half_m, pane_y, low},
                           {half_m, pane_y, low},
                           {half_m, pane_y, high},
                           {-half_m, pane_y, high}},
                          site.palette.panes[0]);
  for (int bar = -1; bar <= 1; ++bar) {
    const double x = 0.5 * half_m * bar;
    AddBlock(site.builder,
             {x - 0.015, y_m + 0.008, low},
             {x + 0.015, pane_y + 0.005, high},
             0.005,
             site.palette.door);
  }
}

// One leaf: a board with raised panels and a handle.
void AddLeaf(const Site& site, double x0, double x1, double height_m, double y_m) {
  const double board_y = y_m + kLeafBack_m;
  site.builder.AddPolygon(
      {{x0, board_y, 0.0}, {x1, board_y, 0.0}, {x1, board_y, height_m}, {x0, board_y, height_m}},
      site.palette.door);
  constexpr double kStile_m = 0.11;
  const double ends[] = {kStile_m, 0.36 * height_m, 0.72 * height_m, height_m};
  for (int panel = 0; panel < 3; ++panel) {
    const double low = ends[panel] + (panel == 0 ? 0.06 : 0.0);
    AddBlock(site.builder,
             {x0 + kStile_m, board_y - 0.02, low},
             {x1 - kStile_m, board_y + 0.01, ends[panel + 1] - kStile_m},
             0.018,
             site.palette.door);
  }
  const double knob_x = x0 < 0.0 ? x1 - 0.055 : x0 + 0.055;
  AddTube(site.builder,
          {{knob_x, board_y, 1.05}, {knob_x, board_y - 0.05, 1.05}, {knob_x, board_y - 0.05, 0.95}},
          0.011,
          8,
          site.palette.zinc);
}

}  // namespace

void BuildDoor(const Site& site, const BayPlan& bay) {
  const double half_m = 0.5 * bay.opening.sizes().x();
  const double height_m = bay.opening.sizes().y();
  const double y_m = site.plan.options.reveal_depth_m;
  AddSteps(site, half_m);
  AddCase(site, half_m, height_m);
  // The frame's foot is sunk in the threshold.
  const double side = half_m + kEmbedded_m;
  const auto frame = WallPath({{-side, -kFrameWidth_m},
                               {side, -kFrameWidth_m},
                               {side, height_m + kEmbedded_m},
                               {-side, height_m + kEmbedded_m}},
                              y_m,
                              /*is_loop=*/true);
  AddSweep(
      site.builder, FrameProfile(kFrameWidth_m, 0.07), frame, site.palette.door, SweepEnds::kLoop);
  const double transom = kFanlightShare * height_m;
  AddBlock(site.builder,
           {-half_m, y_m - 0.02, transom},
           {half_m, y_m + 0.06, transom + 0.1},
           0.01,
           site.palette.door);
  AddFanlight(site, half_m, transom + 0.05, height_m, y_m);
  AddLeaf(site, -half_m, 0.0, transom + 0.05, y_m);
  AddLeaf(site, 0.0, half_m, transom + 0.05, y_m);
  AddBlock(site.builder,
           {-0.03, y_m + 0.005, 0.0},
           {0.03, y_m + kLeafBack_m + 0.005, transom},
           0.008,
           site.palette.door);
}

}  // namespace plumb
