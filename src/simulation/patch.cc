// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

namespace plumb::internal {
namespace {

template <typename Index>
void CheckIndex(const char* what, Index index, std::size_t size) {
  if (index < size) return;
  std::ostringstream message;
  message << "the world's " << what << ' ' << index << " must be below " << size;
  throw std::invalid_argument(message.str());
}

void CheckFinite(const char* what, std::size_t index, bool is_finite) {
  if (is_finite) return;
  std::ostringstream message;
  message << "the world's " << what << ' ' << index << " must be finite";
  throw std::invalid_argument(message.str());
}

void CheckPictures(const World& world) {
  for (const PlatePicture& picture : world.pictures) {
    const auto side = static_cast<std::size_t>(std::max(picture.side_px, 0));
    if (side > 0 && picture.pixels.size() == side * side) continue;
    throw std::invalid_argument("the plate picture \"" + picture.name +
                                "\" must have side_px * side_px pixels, at least one");
  }
  for (const Plate& plate : world.plates) {
    const bool is_known = plate.picture.empty() ||
                          std::any_of(world.pictures.begin(),
                                      world.pictures.end(),
                                      [&](const auto& p) { return p.name == plate.picture; });
    if (!is_known) {
      throw std::invalid_argument("a plate shows the picture \"" + plate.picture +
                                  "\", which the world does not hold");
    }
  }
}

void CheckWorld(const World& world) {
  for (std::size_t i = 0; i < world.vertices_in_world.size(); ++i) {
    CheckFinite("vertex", i, world.vertices_in_world[i].allFinite());
  }
  for (const WorldTriangle& triangle : world.triangles) {
    CheckIndex("facet index", triangle.facet, world.facets.size());
    for (const std::uint32_t vertex : triangle.vertices) {
      CheckIndex("vertex index", vertex, world.vertices_in_world.size());
    }
  }
  for (std::size_t i = 0; i < world.facets.size(); ++i) {
    const Facet& facet = world.facets[i];
    CheckIndex("material index", facet.material, world.materials.size());
    CheckFinite(
        "facet",
        i,
        facet.origin_in_world.allFinite() && facet.u_axis.allFinite() && facet.v_axis.allFinite());
  }
  for (std::size_t i = 0; i < world.plates.size(); ++i) {
    const Plate& plate = world.plates[i];
    CheckFinite(
        "plate", i, plate.world_from_plate.Matrix().allFinite() && std::isfinite(plate.side_m));
  }
  CheckPictures(world);
}

std::uint32_t Hash(std::uint32_t value) {  // Of Murmur3's finaliser.
  value ^= value >> 16;
  value *= 0x85EBCA6BU;
  value ^= value >> 13;
  value *= 0xC2B2AE35U;
  return value ^ (value >> 16);
}

std::uint32_t HashOf(std::uint32_t seed, const Eigen::Vector3d& vector, double step) {
  for (int k = 0; k < 3; ++k) {
    // Rounding at no round number: planes lie at round numbers.
    const auto rounded = static_cast<std::int64_t>(std::floor(vector[k] / step + 0.37));
    seed = Hash(seed ^ static_cast<std::uint32_t>(rounded)) + 0x9E3779B9U;
  }
  return seed;
}

// Where detail is unique, all facets of one plane and direction share one texture, laid from
// the world's origin, so that it runs on from facet to facet.
void SetTexture(const Facet& facet, std::uint32_t seed, Patch* patch) {
  patch->u_axis = facet.u_axis;
  patch->v_axis = facet.v_axis;
  if (facet.copy_of >= 0) {
    patch->texture_origin = facet.origin_in_world;
    patch->texture_seed = Hash(seed ^ Hash(static_cast<std::uint32_t>(facet.copy_of)));
    return;
  }
  const Eigen::Vector3d normal = facet.u_axis.cross(facet.v_axis);
  const double depth = normal.dot(facet.origin_in_world);
  patch->texture_origin = Eigen::Vector3d::Zero();
  patch->texture_seed = HashOf(HashOf(Hash(seed), normal, 1e-3), {depth, 0.0, 0.0}, 1e-3);
}

// Orders planes of one facet; equal but for rounding is equal.
using PlaneKey = std::tuple<int, long long, long long, long long, long long>;

PlaneKey KeyOf(int facet, const Eigen::Vector3d& normal, double offset) {
  const auto round = [](double value) { return std::llround(value * 1e6); };
  return {facet, round(normal.x()), round(normal.y()), round(normal.z()), round(offset)};
}

Eigen::Vector3d UnitNormal(const Triangle3& triangle) {
  const Eigen::Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double length = normal.norm();
  if (length == 0.0) return Eigen::Vector3d::UnitZ();  // Nothing ever meets an empty triangle.
  return normal / length;
}

void AddFacets(const World& world, PatchWorld* result) {
  std::map<PlaneKey, int> patch_of_plane;
  for (const WorldTriangle& world_triangle : world.triangles) {
    Triangle3 triangle;
    for (int k = 0; k < 3; ++k) {
      triangle[k] = world.vertices_in_world[world_triangle.vertices[k]];
    }
    const auto facet = static_cast<int>(world_triangle.facet);
    Patch patch;
    patch.normal = UnitNormal(triangle);
    patch.offset = patch.normal.dot(triangle[0]);
    patch.facet = facet;
    const auto [entry, is_new] = patch_of_plane.emplace(KeyOf(facet, patch.normal, patch.offset),
                                                        static_cast<int>(result->patches.size()));
    if (is_new) {
      SetTexture(world.facets[facet], world.seed, &patch);
      result->patches.push_back(patch);
    }
    result->triangles.push_back(triangle);
    result->patch_of_triangle.push_back(entry->second);
  }
}

void AddPlates(const World& world, PatchWorld* result) {
  for (std::size_t i = 0; i < world.plates.size(); ++i) {
    const Plate& plate = world.plates[i];
    const double half = 0.5 * plate.side_m;
    const auto corner = [&](double x, double y) {
      return Eigen::Vector3d(plate.world_from_plate * Eigen::Vector3d(x * half, y * half, 0.0));
    };
    Patch patch;
    patch.u_axis = plate.world_from_plate.rotation * Eigen::Vector3d::UnitX();
    patch.v_axis = plate.world_from_plate.rotation * Eigen::Vector3d::UnitY();
    patch.normal = plate.world_from_plate.rotation * -Eigen::Vector3d::UnitZ();
    patch.texture_origin = corner(-1.0, -1.0);
    patch.offset = patch.normal.dot(patch.texture_origin);
    patch.plate = static_cast<int>(i);
    result->triangles.push_back({corner(-1, -1), corner(-1, 1), corner(1, 1)});
    result->triangles.push_back({corner(-1, -1), corner(1, 1), corner(1, -1)});
    for (int k = 0; k < 2; ++k) {
      result->patch_of_triangle.push_back(static_cast<int>(result->patches.size()));
    }
    result->patches.push_back(patch);
  }
}

}  // namespace

PatchWorld CutIntoPatches(const World& world) {
  CheckWorld(world);
  PatchWorld result;
  AddFacets(world, &result);
  AddPlates(world, &result);
  return result;
}

}  // namespace plumb::internal
