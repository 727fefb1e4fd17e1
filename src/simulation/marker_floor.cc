// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/marker_floor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "plumbline/common/options.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"
#include "plumbline/marker/marker_picture.h"
#include "plumbline/marker/marker_sheet.h"
#include "simulation/mesh_builder.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

enum RandomUse : std::uint64_t { kPlaceUse = 0x706C616365, kPoseUse = 0x706F7365 };

constexpr double kPi = 3.14159265358979323846;
constexpr int kPictureSide_px = 1024;
constexpr int kInk = 10;  // Reflectances of what is printed, 0..255.
constexpr int kPaperWhite = 200;
constexpr double kFloorSide_m = 60.0;
constexpr double kPaper_m = 0.001;  // Above the floor; a plate as much above the paper.
constexpr int kPaperStrips = 24;
constexpr double kInterval_s = 5.0;

bool IsGrid(const MarkerFloorOptions& options) { return !options.fixed_grid.empty(); }

MarkerSheet SheetOf(const MarkerFloorOptions& options) {
  return LayOutGrid(
      options.fixed_grid == "a3" ? Paper::kA3 : Paper::kA4, Arrangement::kFixed, options.first_id);
}

struct Place {
  int id = 0;
  Eigen::Vector2d center_m;
  double angle_rad = 0.0;
};

std::vector<Place> Places(const MarkerFloorOptions& options) {
  std::vector<Place> places;
  if (IsGrid(options)) {
    const MarkerSheet sheet = SheetOf(options);
    for (const PrintedMarker& marker : sheet.markers) {
      const Eigen::Vector2d off_mm = marker.center_mm - 0.5 * sheet.page_mm;
      places.push_back({marker.id, {0.001 * off_mm.x(), -0.001 * off_mm.y()}, 0.0});
    }
    return places;
  }
  for (int i = 0; i < kGridSide * kGridSide; ++i) {
    RandomNumbers random(DeriveSeed(options.seed, kPlaceUse, static_cast<std::uint64_t>(i)));
    const int row = i / kGridSide;
    const Eigen::Vector2d cell(i % kGridSide - 0.5 * (kGridSide - 1), 0.5 * (kGridSide - 1) - row);
    const double x = random.Uniform(-0.2, 0.2);
    const Eigen::Vector2d off(x, random.Uniform(-0.2, 0.2));
    places.push_back(
        {options.first_id + i, options.spacing_m * (cell + off), random.Uniform(-kPi, kPi)});
  }
  return places;
}

double DiameterOf(const MarkerFloorOptions& options) {
  return IsGrid(options) ? 0.001 * SheetOf(options).diameter_mm : options.diameter_m;
}

// From the first marker's outer edge to the last one's, along the longer side.
double ExtentOf(const MarkerFloorOptions& options) {
  double extent = 0.0;
  for (const Place& place : Places(options)) {
    extent = std::max(extent, 2.0 * place.center_m.cwiseAbs().maxCoeff());
  }
  return extent + kSidePerDiameter * DiameterOf(options);
}

// The arch's height at x, and its slope.
Eigen::Vector2d Arch(const MarkerFloorOptions& options, double extent_m, double x_m) {
  const double share = 2.0 * x_m / extent_m;
  return {options.bend_m * (1.0 - share * share), -4.0 * options.bend_m * share / extent_m};
}

void AddPaper(const MarkerFloorOptions& options, std::uint32_t material, MeshBuilder* builder) {
  const Eigen::Vector2d half = 0.0005 * SheetOf(options).page_mm;
  const double extent_m = ExtentOf(options);
  const auto corner = [&](int step, double y) {
    const double x = half.x() * (2.0 * step / kPaperStrips - 1.0);
    return Eigen::Vector3d(x, y, kPaper_m + std::max(0.0, Arch(options, extent_m, x).x()));
  };
  for (int i = 0; i < kPaperStrips; ++i) {
    builder->AddPolygon({corner(i, -half.y()),
                         corner(i + 1, -half.y()),
                         corner(i + 1, half.y()),
                         corner(i, half.y())},
                        material);
  }
}

Plate MakePlate(const MarkerFloorOptions& options, double extent_m, const Place& place) {
  const Eigen::Vector2d arch = Arch(options, extent_m, place.center_m.x());
  Eigen::Matrix3d world_from_flat;  // Columns: right, down, into the floor.
  world_from_flat << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  Plate plate;
  plate.id = place.id;
  plate.side_m = kSidePerDiameter * DiameterOf(options);
  plate.picture = "marker " + std::to_string(place.id);
  plate.world_from_plate = {
      Eigen::AngleAxisd(-std::atan(arch.y()), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(place.angle_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::Quaterniond(world_from_flat),
      {place.center_m.x(), place.center_m.y(), 2.0 * kPaper_m + std::max(0.0, arch.x())}};
  return plate;
}

std::string PhotoName(int number) {
  std::string digits = std::to_string(number);
  digits.insert(0, 4 - std::min<std::size_t>(4, digits.size()), '0');
  return digits + ".jpg";
}

}  // namespace

std::vector<std::string> MarkerFloorOptions::Problems() const {
  ProblemList problems;
  problems.Require(num_photos >= 0 && num_photos <= 9999, "num_photos", "in [0, 9999]", num_photos);
  problems.Require(fixed_grid.empty() || fixed_grid == "a4" || fixed_grid == "a3",
                   "fixed_grid",
                   "a4, a3 or empty",
                   fixed_grid);
  const int last_id = MarkerCodebook::Get().size() - kGridSide * kGridSide;
  problems.Require(first_id >= 0 && first_id <= last_id,
                   "first_id",
                   ("in [0, " + std::to_string(last_id) + "]").c_str(),
                   first_id);
  problems.Require(
      diameter_m >= 0.01 && diameter_m <= 1.0, "diameter_m", "in [0.01, 1]", diameter_m);
  problems.Require(spacing_m >= 2.5 * diameter_m && spacing_m <= 5.0,
                   "spacing_m",
                   "at least 2.5 diameter_m, so that no two touch, and at most 5",
                   spacing_m);
  problems.Require(bend_m >= 0.0 && bend_m <= 0.2, "bend_m", "in [0, 0.2]", bend_m);
  problems.Require(
      min_fill >= 0.1 && min_fill <= max_fill, "min_fill", "in [0.1, max_fill]", min_fill);
  problems.Require(max_fill <= 3.0, "max_fill", "at most 3", max_fill);
  problems.Require(
      max_tilt_deg >= 0.0 && max_tilt_deg <= 70.0, "max_tilt_deg", "in [0, 70]", max_tilt_deg);
  return problems.Take();
}

World BuildMarkerFloor(const MarkerFloorOptions& options) {
  ThrowIfProblems("floor", options.Problems());
  World world;
  world.seed = options.seed;
  Material concrete;
  concrete.pattern = Pattern::kGround;
  concrete.reflectance = {0.3F, 0.29F, 0.27F};
  Material paper;
  paper.reflectance = {0.78F, 0.78F, 0.78F};
  paper.detail = 0.0F;
  world.materials = {concrete, paper};
  MeshBuilder builder(world);
  const double half = 0.5 * kFloorSide_m;
  builder.AddPolygon(
      {{-half, -half, 0.0}, {half, -half, 0.0}, {half, half, 0.0}, {-half, half, 0.0}}, 0);
  if (IsGrid(options)) AddPaper(options, 1, &builder);
  const double extent_m = ExtentOf(options);
  for (const Place& place : Places(options)) {
    world.plates.push_back(MakePlate(options, extent_m, place));
    PlatePicture picture{
        world.plates.back().picture, kPictureSide_px, MarkerPicture(place.id, kPictureSide_px)};
    for (std::uint8_t& pixel : picture.pixels) {
      pixel = static_cast<std::uint8_t>(kInk + (kPaperWhite - kInk) * pixel / 255);
    }
    world.pictures.push_back(std::move(picture));
  }
  return world;
}

std::vector<PlannedPhoto> PlanFloorPhotos(const MarkerFloorOptions& options,
                                          const Camera& camera,
                                          Timestamp start) {
  ThrowIfProblems("floor", options.Problems());
  const double extent_m = ExtentOf(options);
  std::vector<PlannedPhoto> photos;
  for (int i = 0; i < options.num_photos; ++i) {
    RandomNumbers random(DeriveSeed(options.seed, kPoseUse, static_cast<std::uint64_t>(i)));
    // Steps of 7 and 5 over 12: no two of tilt, distance and turn go together.
    const double tilt = std::sqrt((i * 7 % 12) / 11.0) * options.max_tilt_deg * kPi / 180.0;
    const double fill =
        options.min_fill + (options.max_fill - options.min_fill) * (i * 5 % 12) / 11.0;
    const double azimuth = 2.4 * i + random.Uniform(-0.2, 0.2);
    const double turn = 0.5 * kPi * (i % 4) + random.Uniform(-0.1, 0.1);
    const double x = random.Uniform(-0.15, 0.15) * extent_m;
    const Eigen::Vector3d aim(x, random.Uniform(-0.15, 0.15) * extent_m, 0.0);
    const Eigen::Quaterniond rotation =
        Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)) *
        Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);  // Looks down.
    PlannedPhoto photo;
    photo.name = PhotoName(i + 1);
    photo.distance_m = extent_m * camera.lens()[kFx] / (fill * camera.width_px());
    photo.exposure_time.ns =
        start.ns + static_cast<std::int64_t>(std::llround(i * kInterval_s * 1e9));
    photo.cam_from_world = {rotation, Eigen::Vector3d(0.0, 0.0, photo.distance_m) - rotation * aim};
    photos.push_back(photo);
  }
  return photos;
}

}  // namespace plumb
