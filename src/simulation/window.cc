// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Frames, casements, glazing bars, panes and blinds.
#include "simulation/facade_elements.h"
#include "simulation/profiles.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr double kFrameWidth_m = 0.055;
constexpr double kFrameDepth_m = 0.07;
constexpr double kSashWidth_m = 0.05;
constexpr double kSashBack_m = 0.012;  // Behind the frame's front.
constexpr double kPaneBack_m = 0.035;
constexpr double kOverlap_m = 0.005;
constexpr double kTransomShare = 0.68;
constexpr double kTransomHeight_m = 0.07;
constexpr double kBlindShare = 0.22;
constexpr std::uint64_t kWindowKey = 301;

void AddRing(const Site& site, const WallRect& rect, double front_y_m, double width_m) {
  const Eigen::Vector2d& low = rect.min();
  const Eigen::Vector2d& high = rect.max();
  const auto path =
      WallPath({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, front_y_m, /*is_loop=*/true);
  AddSweep(site.builder,
           FrameProfile(width_m, kFrameDepth_m),
           path,
           site.palette.frame,
           SweepEnds::kLoop);
}

WallRect Grown(const WallRect& rect, double margin_m) {
  return {rect.min() - Eigen::Vector2d::Constant(margin_m),
          rect.max() + Eigen::Vector2d::Constant(margin_m)};
}

void AddBar(const Site& site, const WallRect& rect, double front_y_m, double back_y_m) {
  AddBlock(site.builder,
           {rect.min().x(), front_y_m, rect.min().y()},
           {rect.max().x(), back_y_m, rect.max().y()},
           0.004,
           site.palette.frame);
}

// A sash with its pane and level glazing bars.
void AddSash(const Site& site,
             const WallRect& rect,
             int num_bars,
             double frame_y_m,
             std::uint32_t pane_material) {
  AddRing(site, Grown(rect, kOverlap_m), frame_y_m + kSashBack_m, kSashWidth_m + kOverlap_m);
  const WallRect light = Grown(rect, -kSashWidth_m);
  const WallRect pane = Grown(light, kOverlap_m);
  const double pane_y_m = frame_y_m + kPaneBack_m;
  site.builder.AddPolygon({{pane.min().x(), pane_y_m, pane.min().y()},
                           {pane.max().x(), pane_y_m, pane.min().y()},
                           {pane.max().x(), pane_y_m, pane.max().y()},
                           {pane.min().x(), pane_y_m, pane.max().y()}},
                          pane_material);
  for (int bar = 1; bar <= num_bars; ++bar) {
    const double z = light.min().y() + bar * light.sizes().y() / (num_bars + 1);
    AddBar(site,
           MakeRect(pane.min().x(), z - 0.012, pane.max().x(), z + 0.012),
           frame_y_m + kSashBack_m + 0.004,
           pane_y_m + kOverlap_m);
  }
}

void AddCasements(
    const Site& site, const WallRect& rect, int num_bars, double frame_y_m, RandomNumbers& random) {
  const double middle = rect.center().x();
  const auto& panes = site.palette.panes;
  const auto count = static_cast<int>(panes.size());
  const auto first = static_cast<std::size_t>(random.Index(count));
  const std::size_t second =
      random.Chance(0.8) ? first : static_cast<std::size_t>(random.Index(count));
  const WallRect left = MakeRect(rect.min().x(), rect.min().y(), middle, rect.max().y());
  const WallRect right = MakeRect(middle, rect.min().y(), rect.max().x(), rect.max().y());
  AddSash(site, left, num_bars, frame_y_m, panes[first]);
  AddSash(site, right, num_bars, frame_y_m, panes[second]);
  AddBar(site,
         MakeRect(middle - 0.03, rect.min().y(), middle + 0.03, rect.max().y()),
         frame_y_m - 0.006,
         frame_y_m + kPaneBack_m);
}

// A roller blind before the frame, let down to some height.
void AddBlind(const Site& site, const BayPlan& bay, double frame_y_m, RandomNumbers& random) {
  const double half = 0.5 * bay.opening.sizes().x() - 0.004;
  const double height = bay.opening.sizes().y();
  const double low = height * (1.0 - random.Uniform(0.2, 0.95));
  const BoxFaces faces{true, false, false, true, false};
  AddBox(site.builder,
         {-half, frame_y_m - 0.035, low},
         {half, frame_y_m - 0.01, height - 0.002},
         site.palette.blind,
         faces);
}

}  // namespace

void BuildWindow(const Site& site, const BayPlan& bay) {
  RandomNumbers random(DeriveSeed(site.plan.options.seed, kWindowKey, bay.random_key));
  const double half = 0.5 * bay.opening.sizes().x();
  const double height = bay.opening.sizes().y();
  const double y_m = site.plan.options.reveal_depth_m;
  const WallRect whole = MakeRect(-half, 0.0, half, height);
  AddRing(site, Grown(whole, kOverlap_m), y_m, kFrameWidth_m + kOverlap_m);
  const WallRect inside = Grown(whole, -kFrameWidth_m);
  WallRect casements = inside;
  if (bay.style.look.has_transom && height > 1.5) {
    const double transom = kTransomShare * height;
    casements.max().y() = transom;
    const double above = transom + kTransomHeight_m;
    AddBar(site, MakeRect(-half, transom, half, above), y_m - 0.015, y_m + kFrameDepth_m);
    AddCasements(site,
                 MakeRect(inside.min().x(), above, inside.max().x(), inside.max().y()),
                 0,
                 y_m,
                 random);
  }
  AddCasements(site, casements, bay.style.look.num_glazing_bars, y_m, random);
  if (bay.kind == BayKind::kWindow && random.Chance(kBlindShare)) {
    AddBlind(site, bay, y_m, random);
  }
}

}  // namespace plumb
