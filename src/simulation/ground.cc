// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The ground round the building: pavement, kerb, grass strip, street.
#include <array>

#include "simulation/facade_elements.h"

namespace plumb {
namespace {

constexpr double kPavement_m = 3.0;
constexpr double kGrass_m = 5.0;
constexpr double kKerb_m = 0.16;
constexpr double kStreetDepth_m = 0.12;
constexpr double kReach_m = 80.0;

// A ring round the building between two distances from its walls and two heights.
struct Ring {
  double from_m;
  double to_m;
  double from_z_m;
  double to_z_m;
  std::uint32_t material;
};

std::array<Eigen::Vector3d, 4> Corners(const FacadeOptions& options, double margin_m, double z_m) {
  return {Eigen::Vector3d(-margin_m, -margin_m, z_m),
          Eigen::Vector3d(options.width_m + margin_m, -margin_m, z_m),
          Eigen::Vector3d(options.width_m + margin_m, options.depth_m + margin_m, z_m),
          Eigen::Vector3d(-margin_m, options.depth_m + margin_m, z_m)};
}

void AddRing(const Site& site, const Ring& ring) {
  const auto inner = Corners(site.plan.options, ring.from_m, ring.from_z_m);
  const auto outer = Corners(site.plan.options, ring.to_m, ring.to_z_m);
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t next = (side + 1) % 4;
    site.builder.AddPolygon({outer[side], outer[next], inner[next], inner[side]}, ring.material);
  }
}

}  // namespace

void BuildGround(const Site& site) {
  const Palette& palette = site.palette;
  const double kerb = kPavement_m + kGrass_m;
  const double street = kerb + kKerb_m;
  for (const Ring& ring :
       {Ring{0.0, kPavement_m, 0.0, 0.0, palette.pavement},
        Ring{kPavement_m, kerb, 0.0, 0.0, palette.grass},
        Ring{kerb, street, 0.0, 0.0, palette.kerb},
        Ring{street, street + 0.01, 0.0, -kStreetDepth_m, palette.kerb},
        Ring{street + 0.01, kReach_m, -kStreetDepth_m, -kStreetDepth_m, palette.asphalt}}) {
    AddRing(site, ring);
  }
}

}  // namespace plumb
