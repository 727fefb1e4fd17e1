// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/facade.h"

#include <string>
#include <utility>

#include "plumbline/common/options.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_picture.h"
#include "simulation/facade_elements.h"

namespace plumb {
namespace {

constexpr double kPlainBelowWindow_m = 1.2;  // What a storey needs beside the window's height.
constexpr int kPictureSide_px = 1024;        // 0.6 mm on a marker of 0.5 m.
constexpr int kInk = 10;                     // Reflectances of a printed foil, 0..255.
constexpr int kFoil = 225;

void ShowMarkers(World* world) {
  for (Plate& plate : world->plates) {
    PlatePicture picture;
    picture.name = "marker_" + std::to_string(plate.id);
    picture.side_px = kPictureSide_px;
    picture.pixels = MarkerPicture(plate.id, kPictureSide_px);
    for (std::uint8_t& pixel : picture.pixels) {
      pixel = static_cast<std::uint8_t>(kInk + (kFoil - kInk) * pixel / 255);
    }
    plate.picture = picture.name;
    world->pictures.push_back(std::move(picture));
  }
}

void BuildWall(const Site& site, const WallPlan& wall) {
  const FrameScope frame(site.builder, wall.world_from_wall);
  BuildWallSurface(site, wall);
  BuildPlinth(site, wall);
  BuildQuoins(site, wall);
  BuildDownpipes(site, wall);
  BuildDormers(site, wall);
  for (const std::vector<BayPlan>& storey : wall.storeys) {
    for (const BayPlan& bay : storey) BuildBay(site, bay);
  }
}

}  // namespace

std::vector<std::string> FacadeOptions::Problems() const {
  ProblemList list;
  list.Require(bay_width_m >= 1.5, "bay_width_m", "at least 1.5", bay_width_m);
  list.Require(width_m >= bay_width_m + 1.2 && width_m <= 500.0,
               "width_m",
               "at least bay_width_m + 1.2 and at most 500",
               width_m);
  list.Require(depth_m >= 3.0 && depth_m <= 500.0, "depth_m", "from 3 to 500", depth_m);
  list.Require(plinth_height_m >= 0.4 && plinth_height_m <= 3.0,
               "plinth_height_m",
               "from 0.4 to 3",
               plinth_height_m);
  list.Require(num_storeys >= 1 && num_storeys <= 60, "num_storeys", "from 1 to 60", num_storeys);
  list.Require(window_height_m >= 0.6, "window_height_m", "at least 0.6", window_height_m);
  list.Require(height_m <= 200.0, "height_m", "at most 200", height_m);
  if (num_storeys >= 1) {
    list.Require(StoreyHeight(*this) >= window_height_m + kPlainBelowWindow_m,
                 "height_m",
                 "enough for each storey to be 1.2 m higher than its windows",
                 height_m);
  }
  list.Require(window_width_m >= 0.5 && window_width_m <= 0.9 * bay_width_m / 1.25 - 0.6,
               "window_width_m",
               "from 0.5 to 0.72 bay_width_m - 0.6",
               window_width_m);
  list.Require(reveal_depth_m >= 0.05 && reveal_depth_m <= 0.6,
               "reveal_depth_m",
               "from 0.05 to 0.6",
               reveal_depth_m);
  list.Require(cornice_out_m >= 0.3 && cornice_out_m <= 1.5,
               "cornice_out_m",
               "from 0.3 to 1.5",
               cornice_out_m);
  const auto require_share = [&](const char* field, double value) {
    list.Require(value >= 0.0 && value <= 1.0, field, "from 0 to 1", value);
  };
  require_share("balcony_share", balcony_share);
  require_share("repetition", repetition);
  require_share("textureless_share", textureless_share);
  list.Require(num_doors >= 0, "num_doors", "at least 0", num_doors);
  list.Require(num_downpipes >= 0, "num_downpipes", "at least 0", num_downpipes);
  list.Require(num_targets >= 0 && num_targets <= MarkerCodebook::Get().size(),
               "num_targets",
               "from 0 to the number of marker IDs",
               num_targets);
  list.Require(target_diameter_m >= 0.05 && target_diameter_m <= 2.0,
               "target_diameter_m",
               "from 0.05 to 2",
               target_diameter_m);
  list.Require(detail >= 0.0 && detail <= 3.0, "detail", "from 0 to 3", detail);
  return list.Take();
}

World BuildFacade(const FacadeOptions& options) {
  ThrowIfProblems("facade", options.Problems());
  World world;
  world.seed = options.seed;
  const Palette palette = AddPalette(world, options);
  const FacadePlan plan = PlanFacade(options);
  MeshBuilder builder(world);
  const Site site{builder, palette, plan};
  for (const WallPlan& wall : plan.walls) BuildWall(site, wall);
  BuildStringCourses(site);
  BuildEntablature(site);
  BuildRoof(site);
  BuildGround(site);
  world.plates = PlaceTargets(plan);
  ShowMarkers(&world);
  return world;
}

}  // namespace plumb
