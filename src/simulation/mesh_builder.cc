// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/mesh_builder.h"

#include <Eigen/Geometry>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// Smaller triangles are the closed ends of sweeps and revolutions [m^2].
constexpr double kSmallestArea_m2 = 1e-9;
constexpr double kLevelNormal = 0.999;
// Vertices lie on this grid [m]: to 64 m from the origin it is exact in float, so that the true
// surface is to the last bit what is rendered, and edges that touch have no gap from rounding.
constexpr double kGrid_m = 0x1.0p-18;

Eigen::Vector3d Snapped(const Eigen::Vector3d& point) {
  return kGrid_m * (point / kGrid_m).array().round().matrix();
}

}  // namespace

std::uint32_t MeshBuilder::AddFacet(const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& u_axis,
                                    const Eigen::Vector3d& v_axis,
                                    std::uint32_t material) {
  PLUMB_CHECK_LT(material, world_.materials.size());
  Facet facet;
  facet.origin_in_world = world_from_local_ * origin;
  facet.u_axis = (world_from_local_.rotation * u_axis).normalized();
  facet.v_axis = (world_from_local_.rotation * v_axis).normalized();
  facet.material = material;
  facet.copy_of = NextCopyId();
  facet.is_main_wall = is_main_wall_;
  world_.facets.push_back(facet);
  return static_cast<std::uint32_t>(world_.facets.size() - 1);
}

void MeshBuilder::AddTriangle(const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c,
                              std::uint32_t facet) {
  const std::array<Eigen::Vector3d, 3> corners = {Snapped(world_from_local_ * a),
                                                  Snapped(world_from_local_ * b),
                                                  Snapped(world_from_local_ * c)};
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (0.5 * normal.norm() < kSmallestArea_m2) return;
  const std::size_t first = world_.vertices_in_world.size();
  PLUMB_CHECK_LT(first, std::size_t{0xFFFFFFF0U});
  const auto index = static_cast<std::uint32_t>(first);
  world_.vertices_in_world.insert(world_.vertices_in_world.end(), corners.begin(), corners.end());
  world_.triangles.push_back({{index, index + 1, index + 2}, facet});
}

void MeshBuilder::AddQuad(const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c,
                          const Eigen::Vector3d& d,
                          std::uint32_t facet) {
  AddTriangle(a, b, c, facet);
  AddTriangle(a, c, d, facet);
}

void MeshBuilder::AddPolygon(const std::vector<Eigen::Vector3d>& corners, std::uint32_t material) {
  PLUMB_CHECK_GE(corners.size(), std::size_t{3});
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  }
  if (normal.norm() < 2.0 * kSmallestArea_m2) return;
  normal.normalize();
  const bool is_level = std::abs(normal.z()) > kLevelNormal;
  const Eigen::Vector3d u_axis = is_level ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                          : Eigen::Vector3d::UnitZ().cross(normal).normalized();
  const std::uint32_t facet =
      AddFacet(corners[0], u_axis, normal.cross(u_axis).normalized(), material);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    AddTriangle(corners[0], corners[i - 1], corners[i], facet);
  }
}

int MeshBuilder::NextCopyId() {
  if (copy_group_ == nullptr) return -1;
  if (num_copied_ == copy_group_->size()) copy_group_->push_back(num_copy_ids_++);
  return (*copy_group_)[num_copied_++];
}

FrameScope::FrameScope(MeshBuilder& builder, const Rigid3& parent_from_local)
    : builder_(builder), previous_(builder.world_from_local_) {
  builder.world_from_local_ = previous_ * parent_from_local;
}

CopyScope::CopyScope(MeshBuilder& builder, const std::string& key) : builder_(builder) {
  PLUMB_CHECK(builder.copy_group_ == nullptr);
  if (key.empty()) return;
  builder.copy_group_ = &builder.copy_ids_[key];
  builder.num_copied_ = 0;
}

}  // namespace plumb
