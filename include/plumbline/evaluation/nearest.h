// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "plumbline/evaluation/triangle_mesh.h"

namespace plumb {

struct NearestOnMesh {
  double distance = 0.0;
  std::uint32_t triangle_idx = 0;
};

// Finds what of a mesh is nearest to a point, in double precision (CGAL's AABB tree). Distances are
// in the mesh's unit. Thread-safe: const methods hold no mutable state.
class MeshIndex {
 public:
  // Triangles without area are left out. Throws std::invalid_argument if there are no others.
  explicit MeshIndex(const TriangleMesh& mesh);
  ~MeshIndex();
  MeshIndex(const MeshIndex&) = delete;
  MeshIndex& operator=(const MeshIndex&) = delete;

  NearestOnMesh NearestTo(const Eigen::Vector3d& point) const;

  // Whether a triangle lies between two points.
  bool Blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// The same for a point cloud (nanoflann). Thread-safe: const methods hold no mutable state.
class CloudIndex {
 public:
  // Throws std::invalid_argument if there is no point.
  explicit CloudIndex(std::vector<Eigen::Vector3d> points);
  ~CloudIndex();
  CloudIndex(const CloudIndex&) = delete;
  CloudIndex& operator=(const CloudIndex&) = delete;

  // To the nearest point.
  double DistanceTo(const Eigen::Vector3d& point) const;

  // To the surface that the cloud samples: the least-squares plane through the eight points
  // nearest to `point`, where its foot lies no farther from their centroid than they do, and
  // never more than DistanceTo. A scan's spacing and, in part, its noise then do not count.
  double DistanceToSurface(const Eigen::Vector3d& point) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
