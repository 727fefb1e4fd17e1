// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "common/embree_handle.h"

namespace plumb::internal {

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

using Triangle3 = std::array<Eigen::Vector3d, 3>;

// Sixteen rays.
struct RayPacket {
  static constexpr int kSize = 16;
  bool is_coherent = true;                   // They run side by side.
  alignas(64) std::array<int, kSize> valid;  // -1: trace; 0: leave out.
  alignas(64) std::array<float, kSize> origin_x, origin_y, origin_z;
  alignas(64) std::array<float, kSize> direction_x, direction_y, direction_z;
};

// What a single ray meets first, computed in double.
struct TriangleHit {
  int triangle;
  double along;  // point = origin + along * direction.
};

// Triangles under Embree. Embree computes in float: good to some 1e-7 of the scene's size.
// Thread-safe: immutable.
class RayScene {
 public:
  explicit RayScene(std::vector<Triangle3> triangles);

  // Writes the index of the first triangle that each ray meets, -1 for none.
  void FirstHits(const RayPacket& packet, std::array<int, RayPacket::kSize>* triangles) const;

  // Writes whether each ray meets anything before `max_along`; false for rays left out.
  void AnyHits(const RayPacket& packet,
               float max_along,
               std::array<bool, RayPacket::kSize>* hits) const;

  // The first triangle met with `along` in [min_along, max_along].
  std::optional<TriangleHit> FirstHit(const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction,
                                      double min_along,
                                      double max_along) const;

 private:
  void AddTriangles();
  double PlaneDistance(int triangle,
                       const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) const;

  std::vector<Triangle3> triangles_;
  double scene_radius_ = 0.0;  // Of a sphere around the origin that holds all.
  EmbreeDevice device_;
  EmbreeScene scene_;
};

}  // namespace plumb::internal
