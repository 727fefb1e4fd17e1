// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "test/simulation/test_world.h"

namespace plumb {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::LookAtWall;
using test::MakePaperCamera;
using test::WorldBuilder;

constexpr double kPlateSide_m = 0.16;
constexpr double kBlobRadius = 0.12;  // As a share of the side.

// A dark disc in the middle of white, one pixel soft at its rim.
PlatePicture MakeBlob() {
  PlatePicture blob{"blob", 160, {}};
  for (int row = 0; row < blob.side_px; ++row) {
    for (int column = 0; column < blob.side_px; ++column) {
      const double radius = std::hypot(row + 0.5 - 80.0, column + 0.5 - 80.0);
      const double dark = std::clamp(kBlobRadius * 160.0 + 0.5 - radius, 0.0, 1.0);
      blob.pixels.push_back(static_cast<std::uint8_t>(std::lround(250.0 - 240.0 * dark)));
    }
  }
  return blob;
}

// Plates all over the wall y = 0, side by side, some turned in their plane.
World MakeBlobWall() {
  WorldBuilder builder;
  builder.AddRectangle(builder.AddMaterial({}), {-8, 0, -6}, {16, 0, 0}, {0, 0, 12});
  for (double x = -4.0; x <= 4.0; x += 0.4) {
    for (double z = -3.0; z <= 3.0; z += 0.4) {
      const Eigen::Quaterniond upright(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitX()) *
                                       Eigen::AngleAxisd(0.3 * x, Vector3d::UnitZ()));
      builder.AddPlate({upright, {x, -0.002, z}}, kPlateSide_m, "blob");
    }
  }
  builder.world().pictures.push_back(MakeBlob());
  return builder.world();
}

// Centre of what is darker than the white around `pixel`.
Vector2d CenterOfDarkness(const cv::Mat& photo, const Vector2d& pixel, int half_side_px) {
  const int left = static_cast<int>(std::lround(pixel.x())) - half_side_px;
  const int top = static_cast<int>(std::lround(pixel.y())) - half_side_px;
  const cv::Rect window(left, top, 2 * half_side_px + 1, 2 * half_side_px + 1);
  float white = 0.0F;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      white = std::max(white, photo.at<cv::Vec3f>(y, x)[1]);
    }
  }
  Vector2d sum = Vector2d::Zero();
  double total = 0.0;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      const double dark = white - photo.at<cv::Vec3f>(y, x)[1];
      sum += dark * Vector2d(x, y);
      total += dark;
    }
  }
  return sum / total;
}

// Where the centre of a disc's picture lies: discs are not small enough to be points.
Vector2d CenterOfProjectedBlob(const Camera& camera, const Rigid3& cam_from_plate) {
  Vector2d sum = Vector2d::Zero();
  double total = 0.0;
  constexpr int kRings = 12;
  for (int ring = 0; ring < kRings; ++ring) {
    const double radius_m = kBlobRadius * kPlateSide_m * (ring + 0.5) / kRings;
    for (int i = 0; i < 36; ++i) {
      const double angle = i * M_PI / 18.0;
      const Vector3d point(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
      const auto at = [&](double x, double y) {
        return *camera.Project(cam_from_plate * (point + Vector3d(x, y, 0.0)));
      };
      constexpr double kStep_m = 1e-5;
      const Vector2d by_x = at(kStep_m, 0.0) - at(-kStep_m, 0.0);
      const Vector2d by_y = at(0.0, kStep_m) - at(0.0, -kStep_m);
      const double weight = radius_m * std::abs(by_x.x() * by_y.y() - by_x.y() * by_y.x());
      sum += weight * at(0.0, 0.0);
      total += weight;
    }
  }
  return sum / total;
}

// Half the side of an upright window that holds the disc and lies within the plate.
int HalfWindow(const Camera& camera, const Rigid3& cam_from_plate) {
  const Vector2d center = *camera.Project(cam_from_plate.translation);
  double nearest_px = 1e9;
  for (const Vector3d& side :
       {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, -1, 0)}) {
    const auto end = camera.Project(cam_from_plate * (0.5 * kPlateSide_m * side));
    nearest_px = std::min(nearest_px, (*end - center).norm());
  }
  return static_cast<int>(std::ceil(0.45 * nearest_px));
}

struct BlobErrors {
  int count = 0;
  int near_corners = 0;
  double max_px = 0.0;
};

BlobErrors CompareBlobs(const World& world,
                        const cv::Mat& photo,
                        const Camera& camera,
                        const Rigid3& cam_from_world) {
  BlobErrors errors;
  for (const Plate& plate : world.plates) {
    const Rigid3 cam_from_plate = cam_from_world * plate.world_from_plate;
    const auto pixel = camera.Project(cam_from_plate.translation);
    if (!pixel) continue;
    const int half_side_px = HalfWindow(camera, cam_from_plate);
    if (pixel->x() < half_side_px + 1 || pixel->x() > camera.width_px() - half_side_px - 2 ||
        pixel->y() < half_side_px + 1 || pixel->y() > camera.height_px() - half_side_px - 2) {
      continue;
    }
    const Vector2d seen = CenterOfDarkness(photo, *pixel, half_side_px);
    errors.max_px =
        std::max(errors.max_px, (seen - CenterOfProjectedBlob(camera, cam_from_plate)).norm());
    ++errors.count;
    const double from_center_x = std::abs(pixel->x() / camera.width_px() - 0.5);
    const double from_center_y = std::abs(pixel->y() / camera.height_px() - 0.5);
    if (from_center_x > 0.4 && from_center_y > 0.4) ++errors.near_corners;
  }
  return errors;
}

TEST(Renderer, ShowsAWorldPointWhereTheCameraProjectsIt) {
  const World world = MakeBlobWall();
  const Renderer renderer(world);
  const Camera camera = MakePaperCamera(0.25);
  int near_corners = 0;
  for (const Rigid3& cam_from_world : {LookAtWall({0.1, -4.0, 0.05}),
                                       LookAtWall({1.0, -3.5, -0.4}, 0.3, -0.1, 0.05),
                                       LookAtWall({-0.7, -3.0, 0.6}, -0.2, 0.35, -0.4),
                                       LookAtWall({0.2, -2.5, 0.1}, 0.0, 0.0, 1.5)}) {
    const cv::Mat photo = renderer.Render(camera, cam_from_world, {});
    const BlobErrors errors = CompareBlobs(world, photo, camera, cam_from_world);
    EXPECT_GT(errors.count, 20);
    EXPECT_LT(errors.max_px, 0.05);
    near_corners += errors.near_corners;
  }
  EXPECT_GT(near_corners, 8);
}

TEST(Renderer, IsTheSameWithAnyNumberOfThreads) {
  const Renderer renderer(MakeBlobWall());
  const Camera camera = MakePaperCamera(0.1);
  const Rigid3 cam_from_world = LookAtWall({0.1, -4.0, 0.05}, 0.5);
  const cv::Mat one = renderer.Render(camera, cam_from_world, {}, 2, 1);
  for (const int num_threads : {0, 2, 3}) {
    const cv::Mat other = renderer.Render(camera, cam_from_world, {}, 2, num_threads);
    EXPECT_EQ(cv::norm(one, other, cv::NORM_INF), 0.0) << num_threads;
  }
}

// Mean green of a few pixels around a world point.
float RadianceAt(const cv::Mat& photo,
                 const Camera& camera,
                 const Rigid3& cam_from_world,
                 const Vector3d& point_in_world) {
  const Vector2d pixel = *camera.Project(cam_from_world * point_in_world);
  const cv::Rect window(static_cast<int>(pixel.x()) - 2, static_cast<int>(pixel.y()) - 2, 5, 5);
  return static_cast<float>(cv::mean(photo(window))[1]);
}

TEST(Renderer, ShadowFallsWhereTheSunIsHidden) {
  WorldBuilder builder;
  Material plain;
  plain.detail = 0.0F;
  const std::uint32_t material = builder.AddMaterial(plain);
  builder.AddRectangle(material, {-5, 0, -5}, {10, 0, 0}, {0, 0, 10});
  builder.AddBox(material, {-0.5, -1.0, 1.0}, {0.5, 0.0, 1.2});
  const Renderer renderer(builder.world());
  Light light;
  light.towards_sun_in_world = {0.0, -1.0, 1.0};
  const Camera camera = MakePaperCamera(0.1);
  const Rigid3 cam_from_world = LookAtWall({0.0, -6.0, 0.0});
  const cv::Mat photo = renderer.Render(camera, cam_from_world, light);
  // The box stands out 1 m: at 45 degrees its shadow reaches 1 m down, to z = 0.
  const float shade = RadianceAt(photo, camera, cam_from_world, {0.0, 0.0, 0.06});
  const float lit = RadianceAt(photo, camera, cam_from_world, {0.0, 0.0, -0.2});
  const float beside = RadianceAt(photo, camera, cam_from_world, {1.2, 0.0, 0.5});
  EXPECT_LT(shade, 0.6F * lit);
  EXPECT_NEAR(beside / lit, 1.0, 0.15);
  light.sun_irradiance = 0.0;
  const cv::Mat overcast = renderer.Render(camera, cam_from_world, light);
  EXPECT_LT(RadianceAt(overcast, camera, cam_from_world, {0.0, 0.0, -0.2}), 0.6F * lit);
}

TEST(Renderer, CopiesShowTheSameTextureAndOthersDoNot) {
  const Camera camera = MakePaperCamera(0.1);
  const auto difference_of = [&](int copy_of) {
    WorldBuilder builder;
    const std::uint32_t material = builder.AddMaterial({});
    for (const double x : {0.0, 8.0}) {
      builder.AddRectangle(material, {x, 0, 0}, {7, 0, 0}, {0, 0, 5}).copy_of = copy_of;
    }
    const Renderer renderer(builder.world());
    const cv::Mat first = renderer.Render(camera, LookAtWall({3.5, -4.0, 2.5}), {});
    const cv::Mat second = renderer.Render(camera, LookAtWall({11.5, -4.0, 2.5}), {});
    return cv::norm(first, second, cv::NORM_L1) / static_cast<double>(first.total());
  };
  EXPECT_LT(difference_of(3), 2e-3);
  EXPECT_GT(difference_of(-1), 3e-2);
}

TEST(Renderer, RefusesBrokenLight) {
  const Renderer renderer(MakeBlobWall());
  const Camera camera = MakePaperCamera(0.1);
  Light light;
  light.towards_sun_in_world.setZero();
  EXPECT_THROW(renderer.Render(camera, LookAtWall({0, -4, 0}), light), std::invalid_argument);
  light = Light();
  light.sun_irradiance = -1.0;
  EXPECT_THROW(renderer.Render(camera, LookAtWall({0, -4, 0}), light), std::invalid_argument);
}

TEST(Renderer, RefusesBrokenWorlds) {
  World world = MakeBlobWall();
  world.triangles[0].vertices[1] = 100000;
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
  world = MakeBlobWall();
  world.triangles[0].facet = 7;
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
  world = MakeBlobWall();
  world.facets[0].material = 7;
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
  world = MakeBlobWall();
  world.vertices_in_world[0].x() = std::nan("");
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
  world = MakeBlobWall();
  world.plates[0].picture = "unknown";
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
  world = MakeBlobWall();
  world.pictures[0].pixels.pop_back();
  EXPECT_THROW(Renderer{world}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb
