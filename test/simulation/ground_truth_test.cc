// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The files that come with the photos: surface, laser scan, survey.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "plumbline/common/atomic_file.h"
#include "plumbline/simulation/laser_scan.h"
#include "plumbline/simulation/surface_ply.h"
#include "plumbline/simulation/survey.h"
#include "test/simulation/small_facade.h"

namespace plumb {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::string ReadText(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  return {bytes.begin(), bytes.end()};
}

LaserScanOptions CoarseScan() {
  LaserScanOptions options;
  options.spacing_m = 0.1;
  options.num_stations = 2;
  return options;
}

LaserScan ScanSmallFacade(const LaserScanOptions& options, int num_threads = 0) {
  const World world = BuildFacade(test::SmallFacade());
  const Renderer renderer(world);
  return ScanFacade(world, renderer, test::SmallFacade(), options, num_threads);
}

TEST(WriteSurfacePly, HoldsEveryTriangleAndPlateWithItsMark) {
  const World world = BuildFacade(test::SmallFacade());
  const std::string path = testing::TempDir() + "surface.ply";
  WriteSurfacePly(world, path);
  const std::string text = ReadText(path);
  std::filesystem::remove(path);
  const std::size_t num_vertices = world.vertices_in_world.size() + 4 * world.plates.size();
  const std::size_t num_faces = world.triangles.size() + 2 * world.plates.size();
  EXPECT_THAT(text, HasSubstr("element vertex " + std::to_string(num_vertices) + "\n"));
  EXPECT_THAT(text, HasSubstr("element face " + std::to_string(num_faces) + "\n"));
  const std::string end = "end_header\n";
  const std::size_t body = text.find(end) + end.size();
  constexpr std::size_t kFaceSize = 14;
  ASSERT_EQ(text.size() - body, 24 * num_vertices + kFaceSize * num_faces);
  Vector3d vertex;
  std::memcpy(vertex.data(), text.data() + body + 24, 24);
  EXPECT_EQ(vertex, world.vertices_in_world[1]);
  std::size_t num_wall_faces = 0;
  for (const WorldTriangle& triangle : world.triangles) {
    num_wall_faces += world.facets[triangle.facet].is_main_wall ? 1 : 0;
  }
  std::size_t num_marked = 0;
  for (std::size_t i = 0; i < num_faces; ++i) {
    num_marked += text[body + 24 * num_vertices + kFaceSize * i + 13] == 1 ? 1 : 0;
  }
  EXPECT_EQ(num_marked, num_wall_faces);
}

TEST(WriteSurfacePly, PlatesFaceOutwards) {
  World world;
  world.plates.emplace_back();
  world.plates[0].side_m = 2.0;
  const std::string path = testing::TempDir() + "plate.ply";
  WriteSurfacePly(world, path);
  const std::string text = ReadText(path);
  std::filesystem::remove(path);
  const std::size_t body = text.find("end_header\n") + 11;
  std::array<Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    std::memcpy(corners[k].data(), text.data() + body + 24 * k, 24);
  }
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  EXPECT_LT(normal.z(), 0.0);  // The plate's z points into it.
  EXPECT_NEAR(normal.norm(), 4.0, 1e-12);
}

TEST(WriteSurfacePly, NamesAFileThatCannotBeWritten) {
  try {
    WriteSurfacePly(World(), "/nowhere/surface.ply");
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/surface.ply"));
  }
}

TEST(ScanFacade, WithoutNoisePointsLieOnTheWallAtTheSpacing) {
  LaserScanOptions options = CoarseScan();
  options.range_sigma_m = 0.0;
  const LaserScan scan = ScanSmallFacade(options);
  std::vector<Vector3d> on_wall;
  for (const Vector3d& point : scan.points_in_world) {
    if (std::abs(point.y()) < 1e-5) on_wall.push_back(point);
  }
  ASSERT_GT(on_wall.size(), 1000U);
  for (const Vector3d& point : on_wall) {
    const double row = (point.z() + 1.0) / options.spacing_m - 0.5;
    ASSERT_NEAR(row, std::round(row), 1e-3);
  }
}

TEST(ScanFacade, EveryPointIsSeenFromItsStationAndNoneIsGlass) {
  LaserScanOptions options = CoarseScan();
  options.range_sigma_m = 0.0;
  const World world = BuildFacade(test::SmallFacade());
  const Renderer renderer(world);
  const LaserScan scan = ScanFacade(world, renderer, test::SmallFacade(), options);
  for (const Vector3d& point : scan.points_in_world) {
    int num_seen = 0;
    for (const Vector3d& station : scan.stations_in_world) {
      const auto hit = renderer.Cast(station, point - station);
      ASSERT_TRUE(hit.has_value());
      if ((hit->point_in_world - point).norm() > 1e-3) continue;
      ++num_seen;
      if (hit->triangle < 0) continue;
      const auto& triangle = world.triangles[static_cast<std::size_t>(hit->triangle)];
      ASSERT_NE(world.materials[world.facets[triangle.facet].material].pattern, Pattern::kGlass);
    }
    ASSERT_GE(num_seen, 1);
  }
}

TEST(ScanFacade, NoiseIsAlongTheBeamWithTheGivenSigma) {
  LaserScanOptions options = CoarseScan();
  options.num_stations = 1;
  const LaserScan noisy = ScanSmallFacade(options);
  options.range_sigma_m = 0.0;
  const LaserScan exact = ScanSmallFacade(options);
  ASSERT_EQ(noisy.points_in_world.size(), exact.points_in_world.size());
  double sum2 = 0.0;
  for (std::size_t i = 0; i < exact.points_in_world.size(); ++i) {
    const Vector3d beam = (exact.points_in_world[i] - exact.stations_in_world[0]).normalized();
    const Vector3d noise = noisy.points_in_world[i] - exact.points_in_world[i];
    ASSERT_LT(noise.cross(beam).norm(), 1e-9);
    sum2 += noise.squaredNorm();
  }
  const double sigma_m = std::sqrt(sum2 / static_cast<double>(exact.points_in_world.size()));
  EXPECT_NEAR(sigma_m, 0.002, 0.0001);  // Of over 10000 draws: 2 % is three sigma.
}

TEST(ScanFacade, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(ScanSmallFacade(CoarseScan(), 1).points_in_world,
            ScanSmallFacade(CoarseScan(), 3).points_in_world);
}

TEST(ScanFacade, RefusesOptionsOutOfRange) {
  LaserScanOptions options;
  options.spacing_m = 0.0;
  EXPECT_THROW(ScanSmallFacade(options), std::invalid_argument);
}

TEST(WriteLaserPly, HoldsThePointsAsFloats) {
  LaserScan scan;
  scan.stations_in_world = {{1.0, -15.0, 1.6}};
  scan.points_in_world = {{1.25, -0.5, 2.0}, {3.0, 4.0, 5.0}};
  const std::string path = testing::TempDir() + "laser.ply";
  WriteLaserPly(scan, path);
  const std::string text = ReadText(path);
  std::filesystem::remove(path);
  EXPECT_THAT(text, HasSubstr("comment station 1 -15 1.6\nelement vertex 2\n"));
  Eigen::Vector3f point;
  std::memcpy(point.data(), text.data() + text.size() - 24, 12);
  EXPECT_EQ(point, Eigen::Vector3f(1.25F, -0.5F, 2.0F));
}

TEST(SurveyTargets, MeasuresEveryPlateWithTheGivenNoise) {
  World world;
  for (int id = 0; id < 2000; ++id) {
    Plate plate;
    plate.id = id;
    plate.world_from_plate.translation = Vector3d(id, -0.006, 0.5 * id);
    world.plates.push_back(plate);
  }
  const std::vector<SurveyedTarget> targets = SurveyTargets(world, SurveyOptions());
  ASSERT_EQ(targets.size(), world.plates.size());
  double sum2 = 0.0;
  int num_checks = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    sum2 +=
        (targets[i].point_in_world - world.plates[i].world_from_plate.translation).squaredNorm();
    num_checks += targets[i].is_check ? 1 : 0;
  }
  EXPECT_NEAR(std::sqrt(sum2 / 6000.0), 0.001, 0.00003);
  EXPECT_EQ(num_checks, 600);
}

TEST(SurveyTargets, GivesFiveOfSeventeenPlatesToTheCheck) {
  World world;
  world.plates.resize(17);
  int num_checks = 0;
  for (const SurveyedTarget& target : SurveyTargets(world, SurveyOptions())) {
    num_checks += target.is_check ? 1 : 0;
  }
  EXPECT_EQ(num_checks, 5);
}

TEST(WriteSurveyCsv, NamesUnitsAndRoles) {
  const std::string path = testing::TempDir() + "survey.csv";
  WriteSurveyCsv({{7, {1.25, -0.006, 20.5}, 0.001, false}, {8, {2.0, 0.0, 3.0}, 0.001, true}},
                 path);
  EXPECT_EQ(ReadText(path),
            "id,x_m,y_m,z_m,sigma_m,role\n"
            "7,1.250000,-0.006000,20.500000,0.001000,control\n"
            "8,2.000000,0.000000,3.000000,0.001000,check\n");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace plumb
