// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/ambient_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "image/parallel_for.h"

namespace plumb::internal {
namespace {

constexpr double kGridStep_m = 0.12;
constexpr int kMaxGridPoints = 400;  // Along a side.
constexpr double kNarrow_m = 0.1;    // Across so little nothing changes.

constexpr int kNumDirections = 32;
static_assert(kNumDirections % RayPacket::kSize == 0);
constexpr float kReach_m = 2.5F;      // What stands farther off hides nothing.
constexpr float kHiddenShare = 0.8F;  // What hides the sky is lit too.
constexpr double kOffset_m = 0.005;   // Of the grid points before the surface.

// A ledge that stands out at least so far sheds water, which stains the wall so far below it.
constexpr double kLedge_m = 0.03;
constexpr double kStain_m = 2.2;

// Directions about the z axis, spread in proportion to the cosine with it.
std::vector<Eigen::Vector3d> HalfSphere() {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < kNumDirections; ++i) {
    const double radius2 = (i + 0.5) / kNumDirections;
    const double angle = 2.399963 * i;  // Golden angle.
    const double radius = std::sqrt(radius2);
    directions.emplace_back(
        radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - radius2));
  }
  return directions;
}

float SeenShare(const RayScene& scene,
                const Eigen::Vector3d& point,
                const std::vector<Eigen::Vector3d>& directions) {
  int num_hidden = 0;
  for (int first = 0; first < kNumDirections; first += RayPacket::kSize) {
    RayPacket packet;
    packet.is_coherent = false;
    packet.valid.fill(-1);
    packet.origin_x.fill(static_cast<float>(point.x()));
    packet.origin_y.fill(static_cast<float>(point.y()));
    packet.origin_z.fill(static_cast<float>(point.z()));
    for (int slot = 0; slot < RayPacket::kSize; ++slot) {
      const Eigen::Vector3f direction = directions[first + slot].cast<float>();
      packet.direction_x[slot] = direction.x();
      packet.direction_y[slot] = direction.y();
      packet.direction_z[slot] = direction.z();
    }
    std::array<bool, RayPacket::kSize> hits;
    scene.AnyHits(packet, kReach_m, &hits);
    num_hidden += static_cast<int>(std::count(hits.begin(), hits.end(), true));
  }
  return 1.0F - kHiddenShare * static_cast<float>(num_hidden) / kNumDirections;
}

float RunOff(const RayScene& scene, const Patch& patch, const Eigen::Vector3d& point) {
  if (std::abs(patch.normal.z()) > 0.5) return 0.0F;
  const Eigen::Vector3d up =
      (Eigen::Vector3d::UnitZ() - patch.normal.z() * patch.normal).normalized();
  const auto ledge = scene.FirstHit(point + kLedge_m * patch.normal, up, 0.0, kStain_m);
  if (!ledge) return 0.0F;
  const double share = 1.0 - ledge->along / kStain_m;
  return static_cast<float>(share * share);
}

// A facet of one plane, and the bounds of its texture coordinates.
struct PlaneFacet {
  const Patch* patch = nullptr;
  bool is_plane = true;
  Eigen::AlignedBox2d bounds;
};

std::vector<PlaneFacet> FindPlaneFacets(const PatchWorld& world, int num_facets) {
  std::vector<PlaneFacet> facets(num_facets);
  for (std::size_t i = 0; i < world.triangles.size(); ++i) {
    const Patch& patch = world.patches[world.patch_of_triangle[i]];
    if (patch.facet < 0) continue;
    PlaneFacet& facet = facets[patch.facet];
    if (facet.patch == nullptr) facet.patch = &patch;
    facet.is_plane &= facet.patch == &patch;
    for (const Eigen::Vector3d& corner : world.triangles[i]) {
      const Eigen::Vector3d from_origin = corner - patch.texture_origin;
      facet.bounds.extend(
          Eigen::Vector2d(patch.u_axis.dot(from_origin), patch.v_axis.dot(from_origin)));
    }
  }
  return facets;
}

// Off the border, where neighbours touch.
AmbientMap EmptyMap(const Eigen::AlignedBox2d& bounds) {
  const Eigen::Vector2d inset = (0.1 * bounds.sizes()).cwiseMin(0.01);
  const auto points = [](double size_m) {
    return std::clamp(1 + static_cast<int>(std::ceil(size_m / kGridStep_m)), 2, kMaxGridPoints);
  };
  return {(bounds.min() + inset).cast<float>(),
          (bounds.max() - inset).cast<float>(),
          points(bounds.sizes().x()),
          points(bounds.sizes().y())};
}

AmbientMap Bake(const PlaneFacet& facet,
                const RayScene& scene,
                const std::vector<Eigen::Vector3d>& half_sphere) {
  if (facet.patch == nullptr || !facet.is_plane) return {};
  const Patch& patch = *facet.patch;
  const Eigen::Quaterniond world_from_local =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), patch.normal);
  std::vector<Eigen::Vector3d> directions;
  for (const Eigen::Vector3d& direction : half_sphere) {
    directions.push_back(world_from_local * direction);
  }
  const double depth = patch.offset - patch.normal.dot(patch.texture_origin);
  const Eigen::Vector3d origin = patch.texture_origin + (depth + kOffset_m) * patch.normal;
  AmbientMap map = EmptyMap(facet.bounds);
  const Eigen::Array<bool, 2, 1> is_narrow = facet.bounds.sizes().array() < kNarrow_m;
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      const Eigen::Vector2i first(is_narrow.x() ? 0 : column, is_narrow.y() ? 0 : row);
      if (first != Eigen::Vector2i(column, row)) {
        map.Cell(column, row) = map.Cell(first.x(), first.y());
        continue;
      }
      Eigen::Vector2d uv = map.GridPoint(column, row).cast<double>();
      uv = is_narrow.select(facet.bounds.center(), uv);
      const Eigen::Vector3d point = origin + uv.x() * patch.u_axis + uv.y() * patch.v_axis;
      map.Cell(column, row) = {SeenShare(scene, point, directions), RunOff(scene, patch, point)};
    }
  }
  return map;
}

}  // namespace

AmbientMap::AmbientMap(const Eigen::Vector2f& low,
                       const Eigen::Vector2f& high,
                       int columns,
                       int rows)
    : low_(low),
      cells_per_m_(static_cast<float>(columns - 1) / std::max(high.x() - low.x(), 1e-6F),
                   static_cast<float>(rows - 1) / std::max(high.y() - low.y(), 1e-6F)),
      columns_(columns),
      rows_(rows),
      values_(static_cast<std::size_t>(columns) * rows) {}

Eigen::Vector2f AmbientMap::GridPoint(int column, int row) const {
  const Eigen::Vector2f cells(static_cast<float>(column), static_cast<float>(row));
  return low_ + cells.cwiseQuotient(cells_per_m_);
}

AmbientMap::Value AmbientMap::At(float u, float v) const {
  const float x =
      std::clamp((u - low_.x()) * cells_per_m_.x(), 0.0F, static_cast<float>(columns_ - 1));
  const float y =
      std::clamp((v - low_.y()) * cells_per_m_.y(), 0.0F, static_cast<float>(rows_ - 1));
  const int column = std::min(static_cast<int>(x), columns_ - 2);
  const int row = std::min(static_cast<int>(y), rows_ - 2);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const Value* low = &values_[static_cast<std::size_t>(row) * columns_ + column];
  const Value* high = low + columns_;
  const auto blend = [&](float Value::*field) {
    const float at_low = low[0].*field + fx * (low[1].*field - low[0].*field);
    const float at_high = high[0].*field + fx * (high[1].*field - high[0].*field);
    return at_low + fy * (at_high - at_low);
  };
  return {blend(&Value::seen), blend(&Value::run_off)};
}

std::vector<AmbientMap> BakeAmbientMaps(const PatchWorld& world,
                                        const RayScene& scene,
                                        int num_facets) {
  const std::vector<PlaneFacet> facets = FindPlaneFacets(world, num_facets);
  const std::vector<Eigen::Vector3d> half_sphere = HalfSphere();
  std::vector<AmbientMap> maps(num_facets);
  ParallelFor(/*num_threads=*/0, num_facets, /*part_size=*/1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) maps[i] = Bake(facets[i], scene, half_sphere);
  });
  return maps;
}

}  // namespace plumb::internal
