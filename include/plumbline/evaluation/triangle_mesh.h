// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

// Any set of triangles: it need not be closed, connected or manifold.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Whether each triangle belongs to the wall that is truly flat; empty if that is not known.
  std::vector<char> is_main_wall;
};

double TriangleArea(const TriangleMesh& mesh, std::size_t triangle_idx);

struct SurfaceSample {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::uint32_t triangle_idx = 0;
};

// Points spread evenly over the surface's area: the area, laid out triangle after triangle, is cut
// into num_samples equal parts, and each part gives one point at random. The same seed gives the
// same points. Throws std::invalid_argument if the mesh has no area.
std::vector<SurfaceSample> SampleSurface(const TriangleMesh& mesh,
                                         std::size_t num_samples,
                                         std::uint64_t seed);

}  // namespace plumb
