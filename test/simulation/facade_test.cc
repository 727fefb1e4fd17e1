// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/facade.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "test/simulation/small_facade.h"

namespace plumb {
namespace {

using Eigen::Vector3d;
using test::SmallFacade;

Vector3d Corner(const World& world, const WorldTriangle& triangle, std::size_t corner) {
  return world.vertices_in_world[triangle.vertices[corner]];
}

Vector3d Normal(const World& world, const WorldTriangle& triangle) {
  const Vector3d a = Corner(world, triangle, 0);
  return (Corner(world, triangle, 1) - a).cross(Corner(world, triangle, 2) - a);
}

double MainWallArea(const World& world) {
  double area = 0.0;
  for (const WorldTriangle& triangle : world.triangles) {
    if (world.facets[triangle.facet].is_main_wall) area += 0.5 * Normal(world, triangle).norm();
  }
  return area;
}

TEST(BuildFacade, HasValidIndicesAndNoFlatTriangles) {
  for (const bool closed : {false, true}) {
    FacadeOptions options = SmallFacade();
    options.closed = closed;
    const World world = BuildFacade(options);
    for (const WorldTriangle& triangle : world.triangles) {
      ASSERT_LT(triangle.facet, world.facets.size());
      for (const std::uint32_t vertex : triangle.vertices) {
        ASSERT_LT(vertex, world.vertices_in_world.size());
      }
      ASSERT_GT(Normal(world, triangle).norm(), 1e-10);
    }
    for (const Facet& facet : world.facets) {
      ASSERT_LT(facet.material, world.materials.size());
      ASSERT_NEAR(facet.u_axis.norm(), 1.0, 1e-9);
      ASSERT_NEAR(facet.v_axis.norm(), 1.0, 1e-9);
    }
    for (const Vector3d& vertex : world.vertices_in_world) ASSERT_TRUE(vertex.allFinite());
  }
}

TEST(BuildFacade, MainWallIsThePlaneYZeroFacingOutwards) {
  const World world = BuildFacade(SmallFacade());
  for (const WorldTriangle& triangle : world.triangles) {
    if (!world.facets[triangle.facet].is_main_wall) continue;
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(Corner(world, triangle, k).y(), 0.0);
    ASSERT_LT(Normal(world, triangle).y(), 0.0);
  }
}

TEST(BuildFacade, MainWallIsTheRectangleWithoutItsOpenings) {
  FacadeOptions options = SmallFacade();
  options.num_doors = 0;
  options.balcony_share = 0.0;
  const World world = BuildFacade(options);
  const int num_bays = 3;  // (14 - 2 * 0.6) / 3.6
  const double openings =
      num_bays * options.num_storeys * options.window_width_m * options.window_height_m;
  EXPECT_NEAR(MainWallArea(world), options.width_m * options.height_m - openings, 1e-3);
}

TEST(BuildFacade, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const World first = BuildFacade(SmallFacade());
  const World again = BuildFacade(SmallFacade());
  EXPECT_EQ(first.vertices_in_world, again.vertices_in_world);
  FacadeOptions options = SmallFacade();
  options.seed = 2;
  EXPECT_NE(first.vertices_in_world, BuildFacade(options).vertices_in_world);
}

TEST(BuildFacade, DefaultStaysBelowTwoMillionTriangles) {
  const World world = BuildFacade(FacadeOptions());
  EXPECT_GT(world.triangles.size(), 50000U);
  EXPECT_LT(world.triangles.size(), 2000000U);
  EXPECT_EQ(world.plates.size(), 17U);
}

// The triangles' corners in their facet's frame, one a column.
Eigen::Matrix3Xd Shape(const World& world, const std::vector<std::size_t>& triangles) {
  const Facet& facet = world.facets[world.triangles[triangles.front()].facet];
  Eigen::Matrix3d facet_from_world;
  facet_from_world << facet.u_axis.transpose(), facet.v_axis.transpose(),
      facet.u_axis.cross(facet.v_axis).transpose();
  Eigen::Matrix3Xd shape(3, static_cast<Eigen::Index>(3 * triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      shape.col(static_cast<Eigen::Index>(3 * i + k)) =
          facet_from_world *
          (Corner(world, world.triangles[triangles[i]], k) - facet.origin_in_world);
    }
  }
  return shape;
}

TEST(BuildFacade, WithFullRepetitionFacetsOfACopyHaveTheSameShapeAndTexture) {
  FacadeOptions options = SmallFacade();
  options.repetition = 1.0;
  options.balcony_share = 0.3;
  const World world = BuildFacade(options);
  std::map<std::uint32_t, std::vector<std::size_t>> triangles_of;
  for (std::size_t i = 0; i < world.triangles.size(); ++i) {
    triangles_of[world.triangles[i].facet].push_back(i);
  }
  std::map<int, Eigen::Matrix3Xd> first_shapes;
  std::size_t num_copies = 0;
  for (const auto& [facet, triangles] : triangles_of) {
    const int copy_of = world.facets[facet].copy_of;
    if (copy_of < 0 || world.facets[facet].is_main_wall) continue;
    const Eigen::Matrix3Xd shape = Shape(world, triangles);
    const Eigen::Matrix3Xd& first = first_shapes.emplace(copy_of, shape).first->second;
    ASSERT_EQ(shape.cols(), first.cols());
    ASSERT_LT((shape - first).cwiseAbs().maxCoeff(), 1e-5);  // Vertices are rounded to 4 um.
    num_copies += 1;
  }
  EXPECT_GT(num_copies, 2 * first_shapes.size());
}

TEST(BuildFacade, WithoutRepetitionNothingIsACopy) {
  for (const Facet& facet : BuildFacade(SmallFacade()).facets) ASSERT_EQ(facet.copy_of, -1);
}

TEST(BuildFacade, TexturelessShareMakesTheWallPlain) {
  FacadeOptions options = SmallFacade();
  const auto plain_area = [&](double share) {
    options.textureless_share = share;
    const World world = BuildFacade(options);
    double area = 0.0;
    for (const WorldTriangle& triangle : world.triangles) {
      const Facet& facet = world.facets[triangle.facet];
      if (!facet.is_main_wall || world.materials[facet.material].detail > 0.01F) continue;
      area += 0.5 * Normal(world, triangle).norm();
    }
    return area / (options.width_m * options.height_m);
  };
  EXPECT_EQ(plain_area(0.0), 0.0);
  EXPECT_GT(plain_area(0.67), 0.4);
  EXPECT_GT(plain_area(1.0), 0.7);
}

TEST(BuildFacade, PlatesFaceOutwardsApartFromOneAnotherOverTheWholeWall) {
  const FacadeOptions options;
  const World world = BuildFacade(options);
  Eigen::AlignedBox3d extent;
  for (const Plate& plate : world.plates) {
    const Vector3d center = plate.world_from_plate.translation;
    extent.extend(center);
    EXPECT_LT(center.y(), 0.0);
    EXPECT_GT(center.y(), -0.1);
    EXPECT_THAT((plate.world_from_plate.rotation * Vector3d::UnitZ()).y(),
                testing::DoubleNear(1.0, 1e-12));
    EXPECT_THAT((plate.world_from_plate.rotation * Vector3d::UnitY()).z(),
                testing::DoubleNear(-1.0, 1e-12));
    for (const Plate& other : world.plates) {
      if (other.id == plate.id) continue;
      EXPECT_GT((other.world_from_plate.translation - center).norm(), 3.0);
    }
  }
  EXPECT_GT(extent.sizes().x(), 0.8 * options.width_m);
  EXPECT_GT(extent.sizes().z(), 0.7 * options.height_m);
}

TEST(BuildFacade, NamesEveryOptionThatIsOutOfRange) {
  FacadeOptions options;
  options.width_m = 1.0;
  options.repetition = 1.5;
  options.num_storeys = 20;
  EXPECT_THAT(options.Problems(),
              testing::UnorderedElementsAre(testing::HasSubstr("width_m"),
                                            testing::HasSubstr("repetition"),
                                            testing::HasSubstr("height_m must be enough")));
  EXPECT_THROW(BuildFacade(options), std::invalid_argument);
}

TEST(BuildFacade, SaysWhenThePlatesDoNotFit) {
  FacadeOptions options = SmallFacade();
  options.num_targets = 500;
  try {
    BuildFacade(options);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("num_targets"));
  }
}

}  // namespace
}  // namespace plumb
