// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "plumbline/simulation/world.h"

namespace plumb {

// Adds triangles and facets to a world. Coordinates are those of the current local frame.
class MeshBuilder {
 public:
  explicit MeshBuilder(World& world) : world_(world) {}

  std::uint32_t AddFacet(const Eigen::Vector3d& origin,
                         const Eigen::Vector3d& u_axis,
                         const Eigen::Vector3d& v_axis,
                         std::uint32_t material);
  // The facets added from now on are, or are not, part of the flat main wall.
  void MarkMainWall(bool is_main_wall) { is_main_wall_ = is_main_wall; }

  // Vertices anticlockwise seen from outside. Triangles without area are left out.
  void AddTriangle(const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b,
                   const Eigen::Vector3d& c,
                   std::uint32_t facet);
  void AddQuad(const Eigen::Vector3d& a,
               const Eigen::Vector3d& b,
               const Eigen::Vector3d& c,
               const Eigen::Vector3d& d,
               std::uint32_t facet);

  // A plane convex polygon with its own facet: u is level, v points up (to the local +y where the
  // polygon is level), the origin is the first corner.
  void AddPolygon(const std::vector<Eigen::Vector3d>& corners, std::uint32_t material);

 private:
  friend class FrameScope;
  friend class CopyScope;

  int NextCopyId();

  World& world_;
  Rigid3 world_from_local_;
  bool is_main_wall_ = false;
  std::map<std::string, std::vector<int>> copy_ids_;
  std::vector<int>* copy_group_ = nullptr;
  std::size_t num_copied_ = 0;
  int num_copy_ids_ = 0;
};

// While it lives, local coordinates are those of a frame inside the builder's previous one.
class FrameScope {
 public:
  FrameScope(MeshBuilder& builder, const Rigid3& parent_from_local);
  FrameScope(MeshBuilder& builder, const Eigen::Vector3d& origin_in_parent)
      : FrameScope(builder, Rigid3(Eigen::Quaterniond::Identity(), origin_in_parent)) {}
  ~FrameScope() { builder_.world_from_local_ = previous_; }
  FrameScope(const FrameScope&) = delete;
  FrameScope& operator=(const FrameScope&) = delete;

 private:
  MeshBuilder& builder_;
  Rigid3 previous_;
};

// While it lives, the n-th facet added is a copy (Facet::copy_of) of the n-th facet added under the
// same key before. An empty key: unique facets. Scopes do not nest.
class CopyScope {
 public:
  CopyScope(MeshBuilder& builder, const std::string& key);
  ~CopyScope() { builder_.copy_group_ = nullptr; }
  CopyScope(const CopyScope&) = delete;
  CopyScope& operator=(const CopyScope&) = delete;

 private:
  MeshBuilder& builder_;
};

}  // namespace plumb
