// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is round a window on the wall: surround, sill, hood, pediment, keystone, apron.
#include <algorithm>
#include <cmath>

#include "simulation/facade_elements.h"
#include "simulation/profiles.h"

namespace plumb {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSillHeight_m = 0.09;
constexpr double kSillOut_m = 0.11;
constexpr double kFriezeHeight_m = 0.12;
constexpr double kHoodHeight_m = 0.15;
constexpr double kHoodOut_m = 0.17;
constexpr double kRakeHeight_m = 0.11;
constexpr int kNumArcPieces = 12;

struct Opening {
  double half_m;
  double height_m;
};

void AddSill(const Site& site, const Opening& opening, double margin_m) {
  AddMoulding(site.builder,
              SillProfile(kSillHeight_m, kSillOut_m),
              -opening.half_m - margin_m,
              opening.half_m + margin_m,
              -kSillHeight_m,
              site.palette.trim);
}

void AddSurround(const Site& site, const Opening& opening, const WindowLook& look) {
  const auto path = WallPath({{-opening.half_m, 0.0},
                              {-opening.half_m, opening.height_m},
                              {opening.half_m, opening.height_m},
                              {opening.half_m, 0.0}},
                             0.0);
  AddSweep(site.builder,
           ArchitraveProfile(look.surround_width_m, look.surround_out_m),
           path,
           site.palette.trim,
           SweepEnds::kCapped);
}

void AddKeystone(const Site& site, const Opening& opening, double out_m, double top_m) {
  AddBlock(site.builder,
           {-0.1, -out_m, opening.height_m - 0.03},
           {0.1, kEmbedded_m, top_m},
           0.02,
           site.palette.trim);
}

// The raking or round cornice above a hood, with the field that it frames.
void AddPediment(const Site& site, double half_m, double foot_m, double rise_m, HoodKind kind) {
  std::vector<Vector2d> path;
  const int pieces = kind == HoodKind::kTriangular ? 2 : kNumArcPieces;
  for (int k = 0; k <= pieces; ++k) {
    const double share = 2.0 * k / pieces - 1.0;  // -1 .. 1
    const double height_share =
        kind == HoodKind::kTriangular ? 1.0 - std::abs(share) : 1.0 - share * share;
    path.emplace_back(half_m * share, foot_m + rise_m * height_share);
  }
  AddSweep(site.builder,
           HoodProfile(kRakeHeight_m, kHoodOut_m),
           WallPath(path, 0.0),
           site.palette.trim,
           SweepEnds::kCapped);
  std::vector<Vector3d> field;
  for (auto point = path.rbegin(); point != path.rend(); ++point) {
    field.emplace_back(point->x(), -0.03, point->y());
  }
  site.builder.AddPolygon(field, site.palette.trim);
}

void AddHood(const Site& site, const BayPlan& bay, const Opening& opening) {
  const WindowLook& look = bay.style.look;
  const double half_m = opening.half_m + look.surround_width_m + 0.1;
  const double frieze_m = opening.height_m + look.surround_width_m;
  const double hood_m = frieze_m + kFriezeHeight_m;
  const Profile hood = HoodProfile(kHoodHeight_m, kHoodOut_m);
  AddBox(site.builder,
         {-opening.half_m - look.surround_width_m, -0.03, frieze_m},
         {opening.half_m + look.surround_width_m, kEmbedded_m, hood_m},
         site.palette.trim,
         {true, false, true, false, false});
  AddMoulding(site.builder, hood, -half_m, half_m, hood_m, site.palette.trim);
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (opening.half_m + 0.5 * look.surround_width_m);
    AddMoulding(site.builder,
                BracketProfile(0.3, 0.14),
                x - 0.05,
                x + 0.05,
                hood_m - 0.3,
                site.palette.trim);
  }
  const double room_m =
      bay.cell.max().y() - bay.opening.max().y() + opening.height_m - hood_m - kHoodHeight_m;
  const double rise_m = std::min(0.36 * half_m, room_m - kRakeHeight_m - 0.1);
  if (bay.hood != HoodKind::kStraight && rise_m > 0.1) {
    AddPediment(site, half_m, hood_m + kHoodHeight_m - 0.01, rise_m, bay.hood);
  }
}

void AddApron(const Site& site, const BayPlan& bay, const Opening& opening) {
  const double room_m =
      bay.opening.min().y() - bay.cell.min().y() - bay.style.course_height_m - 0.04;
  const double low = -room_m;
  const double high = -kSillHeight_m - 0.03;
  if (high - low < 0.15) return;
  const double half_m = opening.half_m + bay.style.look.surround_width_m;
  AddBlock(
      site.builder, {-half_m, -0.025, low}, {half_m, kEmbedded_m, high}, 0.008, site.palette.trim);
  AddBlock(site.builder,
           {-half_m + 0.09, -0.05, low + 0.06},
           {half_m - 0.09, 0.0, high - 0.06},
           0.02,
           site.palette.trim);
}

}  // namespace

void BuildWindowDress(const Site& site, const BayPlan& bay) {
  const Opening opening{0.5 * bay.opening.sizes().x(), bay.opening.sizes().y()};
  const WindowLook& look = bay.style.look;
  const bool is_rusticated = bay.style.wall == WallKind::kRusticated;
  if (bay.kind == BayKind::kWindow) {
    AddSill(site, opening, is_rusticated ? 0.06 : look.surround_width_m + 0.04);
  }
  if (is_rusticated) {
    AddKeystone(site, opening, kRustication_m + 0.05, opening.height_m + 0.4);
    return;
  }
  if (bay.style.wall == WallKind::kPlain) return;
  AddSurround(site, opening, look);
  if (look.has_keystone) {
    AddKeystone(
        site, opening, look.surround_out_m + 0.04, opening.height_m + look.surround_width_m + 0.07);
  }
  if (bay.hood != HoodKind::kNone) AddHood(site, bay, opening);
  if (look.has_apron && bay.kind == BayKind::kWindow) AddApron(site, bay, opening);
}

}  // namespace plumb
