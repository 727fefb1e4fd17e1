// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One bay: what belongs to its opening, in order, as copies where asked for.
#include "simulation/facade_elements.h"

namespace plumb {
namespace {

constexpr double kBehindFrame_m = 0.08;

}  // namespace

bool HasShutters(const BayPlan& bay) {
  const double room_m = bay.cell.sizes().x() - 2.0 * bay.opening.sizes().x();
  return bay.kind == BayKind::kWindow && bay.style.look.has_shutters && room_m > 0.7;
}

void BuildReveal(const Site& site, const BayPlan& bay) {
  const double half = 0.5 * bay.opening.sizes().x();
  const double height = bay.opening.sizes().y();
  const double back = site.plan.options.reveal_depth_m + kBehindFrame_m;
  const std::uint32_t material =
      bay.style.wall == WallKind::kPlain ? site.palette.plain : site.palette.reveal;
  MeshBuilder& builder = site.builder;
  builder.AddPolygon({{-half, 0, 0}, {-half, back, 0}, {-half, back, height}, {-half, 0, height}},
                     material);
  builder.AddPolygon({{half, back, 0}, {half, 0, 0}, {half, 0, height}, {half, back, height}},
                     material);
  builder.AddPolygon({{-half, 0, 0}, {half, 0, 0}, {half, back, 0}, {-half, back, 0}}, material);
  builder.AddPolygon(
      {{-half, back, height}, {half, back, height}, {half, 0, height}, {-half, 0, height}},
      material);
}

void BuildBay(const Site& site, const BayPlan& bay) {
  const CopyScope copies(site.builder, bay.copy_key.empty() ? "" : "bay/" + bay.copy_key);
  if (bay.style.wall == WallKind::kRusticated) {
    // In the cell's frame, so that copies are equal to the last bit.
    BayPlan local = bay;
    const Eigen::Vector2d corner = bay.cell.min();
    local.cell.translate(-corner);
    if (bay.kind != BayKind::kBlank) local.opening.translate(-corner);
    const FrameScope frame(site.builder, {corner.x(), 0.0, corner.y()});
    BuildRustication(site, local);
  }
  if (bay.kind == BayKind::kBlank) return;
  const FrameScope frame(site.builder, {bay.opening.center().x(), 0.0, bay.opening.min().y()});
  BuildReveal(site, bay);
  BuildFittings(site, bay);
  if (bay.kind == BayKind::kDoor) {
    BuildDoor(site, bay);
    return;
  }
  BuildWindow(site, bay);
  BuildWindowDress(site, bay);
  if (HasShutters(bay)) BuildShutters(site, bay);
  if (bay.kind == BayKind::kBalcony) BuildBalcony(site, bay);
}

}  // namespace plumb
