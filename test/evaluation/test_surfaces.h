// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "plumbline/evaluation/triangle_mesh.h"

namespace plumb::test {

// Two triangles of the plane spanned at `corner`; anticlockwise seen from side1 x side2.
inline void AddRectangle(const Eigen::Vector3d& corner,
                         const Eigen::Vector3d& side1,
                         const Eigen::Vector3d& side2,
                         bool is_main_wall,
                         TriangleMesh* mesh) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  for (const Eigen::Vector3d& vertex : {corner,
                                        Eigen::Vector3d(corner + side1),
                                        Eigen::Vector3d(corner + side1 + side2),
                                        Eigen::Vector3d(corner + side2)}) {
    mesh->vertices.push_back(vertex);
  }
  mesh->triangles.push_back({first, first + 1, first + 2});
  mesh->triangles.push_back({first, first + 2, first + 3});
  mesh->is_main_wall.insert(mesh->is_main_wall.end(), 2, is_main_wall ? 1 : 0);
}

// A wall of 20 m x 10 m in y = 0 that faces -y, and a sill of 1 m depth before its foot.
inline TriangleMesh MakeWall() {
  TriangleMesh mesh;
  AddRectangle({0, 0, 0}, {20, 0, 0}, {0, 0, 10}, true, &mesh);
  AddRectangle({0, 0, 0}, {0, -1, 0}, {20, 0, 0}, false, &mesh);
  return mesh;
}

// A sphere about the origin from rings of latitude and longitude.
inline TriangleMesh MakeSphere(double radius, std::uint32_t num_rings) {
  TriangleMesh mesh;
  const std::uint32_t num_around = 2 * num_rings;
  for (std::uint32_t ring = 0; ring <= num_rings; ++ring) {
    for (std::uint32_t step = 0; step < num_around; ++step) {
      const double polar = M_PI * ring / num_rings;
      const double azimuth = 2.0 * M_PI * step / num_around;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(azimuth),
                                 radius * std::sin(polar) * std::sin(azimuth),
                                 radius * std::cos(polar));
    }
  }
  for (std::uint32_t ring = 0; ring < num_rings; ++ring) {
    for (std::uint32_t step = 0; step < num_around; ++step) {
      const std::uint32_t a = ring * num_around + step;
      const std::uint32_t b = ring * num_around + (step + 1) % num_around;
      mesh.triangles.push_back({a, a + num_around, b});
      mesh.triangles.push_back({b, a + num_around, b + num_around});
    }
  }
  return mesh;
}

}  // namespace plumb::test
