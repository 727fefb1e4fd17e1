// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The flat walls with their openings, the plinth and the ground storey's rusticated blocks.
#include <algorithm>
#include <set>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr double kPlinthOut_m = 0.08;
constexpr double kCourseHeight_m = 0.45;  // Of the rusticated blocks.
constexpr double kBlockLength_m = 0.95;
constexpr double kBlockBevel_m = 0.018;
constexpr double kQuoinHeight_m = 0.42;

// A piece of the wall with one facet: a bay's cell of one storey, or what lies beside and between.
struct Panel {
  WallRect rect;
  std::uint32_t material;
  const BayPlan* bay = nullptr;
};

std::uint32_t WallMaterial(const Palette& palette, WallKind wall) {
  switch (wall) {
    case WallKind::kRusticated:
      return palette.ashlar;
    case WallKind::kBrick:
      return palette.brick;
    case WallKind::kPlain:
      return palette.plain;
    case WallKind::kPlaster:
      break;
  }
  return palette.plaster;
}

void AddStoreyPanels(const Site& site,
                     const WallPlan& wall,
                     std::size_t storey,
                     std::vector<Panel>& panels) {
  const std::uint32_t material = WallMaterial(site.palette, site.plan.styles[storey].wall);
  const double z0 = site.plan.floors_m[storey];
  const double z1 = site.plan.floors_m[storey + 1];
  if (wall.storeys.empty()) {
    panels.push_back({MakeRect(0.0, z0, wall.width_m, z1), material});
    return;
  }
  panels.push_back({MakeRect(0.0, z0, wall.bay_edges_m.front(), z1), material});
  for (const BayPlan& bay : wall.storeys[storey]) panels.push_back({bay.cell, material, &bay});
  panels.push_back({MakeRect(wall.bay_edges_m.back(), z0, wall.width_m, z1), material});
}

std::vector<Panel> MakePanels(const Site& site, const WallPlan& wall) {
  const double height_m = site.plan.options.height_m;
  std::vector<Panel> panels = {
      {MakeRect(0.0, 0.0, wall.width_m, site.plan.floors_m.front()), site.palette.plinth_stone},
      {MakeRect(0.0, site.plan.floors_m.back(), wall.width_m, height_m), site.palette.trim}};
  for (std::size_t storey = 0; storey < site.plan.styles.size(); ++storey) {
    AddStoreyPanels(site, wall, storey, panels);
  }
  return panels;
}

void AddOpenings(const WallPlan& wall, std::vector<WallRect>& openings) {
  for (const std::vector<BayPlan>& storey : wall.storeys) {
    for (const BayPlan& bay : storey) {
      if (bay.kind != BayKind::kBlank) openings.push_back(bay.opening);
    }
  }
}

// Lines of one grid over the whole wall, so that no corner lies on another's edge.
std::vector<double> GridLines(const std::vector<Panel>& panels,
                              const std::vector<WallRect>& openings,
                              int axis) {
  std::set<double> lines;
  for (const Panel& panel : panels) lines.insert({panel.rect.min()[axis], panel.rect.max()[axis]});
  for (const WallRect& opening : openings) lines.insert({opening.min()[axis], opening.max()[axis]});
  return {lines.begin(), lines.end()};
}

bool IsOpen(const std::vector<WallRect>& openings, const Eigen::Vector2d& point) {
  return std::any_of(openings.begin(), openings.end(), [&](const WallRect& opening) {
    return opening.contains(point);
  });
}

// The part of `lines` from low to high.
std::vector<double> Between(const std::vector<double>& lines, double low, double high) {
  return {std::lower_bound(lines.begin(), lines.end(), low),
          std::upper_bound(lines.begin(), lines.end(), high)};
}

void AddPanel(const Site& site,
              const Panel& panel,
              const std::vector<double>& xs,
              const std::vector<double>& zs,
              const std::vector<WallRect>& openings) {
  const bool is_copy = panel.bay != nullptr && !panel.bay->copy_key.empty();
  const CopyScope scope(site.builder, is_copy ? "wall/" + panel.bay->copy_key : "");
  // Unless copied, bricks run on from bay to bay.
  const Eigen::Vector3d origin(is_copy ? panel.rect.min().x() : 0.0, 0.0, panel.rect.min().y());
  const std::uint32_t facet = site.builder.AddFacet(
      origin, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), panel.material);
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
      if (IsOpen(openings, {0.5 * (xs[i] + xs[i + 1]), 0.5 * (zs[j] + zs[j + 1])})) continue;
      site.builder.AddQuad({xs[i], 0.0, zs[j]},
                           {xs[i + 1], 0.0, zs[j]},
                           {xs[i + 1], 0.0, zs[j + 1]},
                           {xs[i], 0.0, zs[j + 1]},
                           facet);
    }
  }
}

// Blocks of one row in running bond: in every other row the blocks go on into the next bay.
void AddBlocks(
    const Site& site, const BayPlan& bay, double x0, double x1, double z0, double z1, int row) {
  if (x1 - x0 < 0.05 || z1 - z0 < 0.05) return;
  const double length_m = x1 - x0;
  const double step_m = length_m / FittedCount(length_m, kBlockLength_m);
  const bool is_shifted = row % 2 == 1;
  RandomNumbers random(
      DeriveSeed(site.plan.options.seed, bay.random_key, static_cast<std::uint64_t>(row)));
  for (double x = is_shifted ? x0 - 0.5 * step_m : x0; x < x1 - 1e-6; x += step_m) {
    const double left = std::max(x, x0);
    const double right = std::min(x + step_m, x1);
    if (right - left < 2.5 * kBlockBevel_m) continue;
    const bool from_left = is_shifted && left == bay.cell.min().x();
    const bool to_right = is_shifted && right == bay.cell.max().x();
    const bool is_worn = bay.copy_key.empty() && !from_left && !to_right;
    AddBlock(site.builder,
             {left, -kRustication_m + (is_worn ? random.Uniform(0.0, 0.004) : 0.0), z0},
             {right, kEmbedded_m, z1},
             kBlockBevel_m,
             from_left ? 0.0 : kBlockBevel_m,
             to_right ? 0.0 : kBlockBevel_m,
             site.palette.ashlar);
  }
}

}  // namespace

void BuildWallSurface(const Site& site, const WallPlan& wall) {
  const std::vector<Panel> panels = MakePanels(site, wall);
  std::vector<WallRect> openings;
  AddOpenings(wall, openings);
  const std::vector<double> xs = GridLines(panels, openings, 0);
  const std::vector<double> zs = GridLines(panels, openings, 1);
  site.builder.MarkMainWall(wall.is_main);
  for (const Panel& panel : panels) {
    AddPanel(site,
             panel,
             Between(xs, panel.rect.min().x(), panel.rect.max().x()),
             Between(zs, panel.rect.min().y(), panel.rect.max().y()),
             openings);
  }
  site.builder.MarkMainWall(false);
}

void BuildPlinth(const Site& site, const WallPlan& wall) {
  std::vector<std::pair<double, double>> gaps;
  for (const std::vector<BayPlan>& storey : wall.storeys) {
    for (const BayPlan& bay : storey) {
      if (bay.kind != BayKind::kDoor) continue;
      gaps.emplace_back(bay.opening.min().x(), bay.opening.max().x());
    }
  }
  const Profile profile = PlinthProfile(site.plan.options.plinth_height_m, kPlinthOut_m);
  double start = -kPlinthOut_m;
  const auto add_until = [&](double end) {
    AddMoulding(site.builder, profile, start, end, 0.0, site.palette.plinth_stone);
  };
  for (const auto& [low, high] : gaps) {
    add_until(low);
    start = high;
  }
  add_until(wall.width_m + kPlinthOut_m);
}

void BuildRustication(const Site& site, const BayPlan& bay) {
  const double floor = bay.cell.min().y();
  const int num_rows = FittedCount(bay.cell.sizes().y(), kCourseHeight_m);
  const double row_m = bay.cell.sizes().y() / num_rows;
  const double x0 = bay.cell.min().x();
  const double x1 = bay.cell.max().x();
  for (int row = 0; row < num_rows; ++row) {
    const double z0 = floor + row * row_m;
    const double z1 = z0 + row_m;
    if (bay.kind == BayKind::kBlank) {
      AddBlocks(site, bay, x0, x1, z0, z1, row);
      continue;
    }
    // Beside the opening, and what of the row lies below or above it.
    const double low = std::clamp(bay.opening.min().y(), z0, z1);
    const double high = std::clamp(bay.opening.max().y(), z0, z1);
    AddBlocks(site, bay, x0, bay.opening.min().x(), z0, z1, row);
    AddBlocks(site, bay, bay.opening.max().x(), x1, z0, z1, row);
    AddBlocks(site, bay, bay.opening.min().x(), bay.opening.max().x(), z0, low, row);
    if (high > low || z0 >= bay.opening.max().y()) {
      AddBlocks(site, bay, bay.opening.min().x(), bay.opening.max().x(), high, z1, row);
    }
  }
}

void BuildQuoins(const Site& site, const WallPlan& wall) {
  const double z0 = site.plan.floors_m.front();
  const double z1 = site.plan.floors_m.back();
  const auto count = FittedCount(z1 - z0, kQuoinHeight_m);
  const double step_m = (z1 - z0) / count;
  for (int k = 0; k < count; ++k) {
    const double low = z0 + k * step_m;
    // Long on one wall where short on the other.
    const double left_m = k % 2 == 0 ? 0.55 : 0.35;
    const double right_m = k % 2 == 0 ? 0.35 : 0.55;
    AddBlock(site.builder,
             {-kRustication_m, -kRustication_m, low},
             {left_m, kEmbedded_m, low + step_m},
             kBlockBevel_m,
             site.palette.ashlar);
    AddBlock(site.builder,
             {wall.width_m - right_m, -kRustication_m, low},
             {wall.width_m + kRustication_m, kEmbedded_m, low + step_m},
             kBlockBevel_m,
             site.palette.ashlar);
  }
}

}  // namespace plumb
