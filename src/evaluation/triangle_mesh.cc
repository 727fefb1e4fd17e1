// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace plumb {
namespace {

// 0 to below 1, the same with every standard library.
double Uniform(std::mt19937_64* random) {
  return static_cast<double>((*random)() >> 11) * 0x1.0p-53;
}

// Evenly within a triangle (Osada et al., Shape Distributions, ACM TOG 21(4), 2002, eq. 1).
Eigen::Vector3d PointInTriangle(const TriangleMesh& mesh,
                                std::size_t triangle_idx,
                                std::mt19937_64* random) {
  const auto& corner = mesh.triangles[triangle_idx];
  const double root = std::sqrt(Uniform(random));
  const double along = Uniform(random);
  return (1.0 - root) * mesh.vertices[corner[0]] + root * (1.0 - along) * mesh.vertices[corner[1]] +
         root * along * mesh.vertices[corner[2]];
}

}  // namespace

double TriangleArea(const TriangleMesh& mesh, std::size_t triangle_idx) {
  const auto& corner = mesh.triangles[triangle_idx];
  const Eigen::Vector3d& a = mesh.vertices[corner[0]];
  return 0.5 * (mesh.vertices[corner[1]] - a).cross(mesh.vertices[corner[2]] - a).norm();
}

std::vector<SurfaceSample> SampleSurface(const TriangleMesh& mesh,
                                         std::size_t num_samples,
                                         std::uint64_t seed) {
  std::vector<double> area_up_to(mesh.triangles.size());  // Inclusive.
  double area = 0.0;
  for (std::size_t i = 0; i < area_up_to.size(); ++i) {
    area += TriangleArea(mesh, i);
    area_up_to[i] = area;
  }
  if (!(area > 0.0)) throw std::invalid_argument("the mesh has no area to sample");
  std::mt19937_64 random(seed);
  std::vector<SurfaceSample> samples;
  samples.reserve(num_samples);
  std::size_t triangle_idx = 0;
  for (std::size_t i = 0; i < num_samples; ++i) {
    const double share =
        (static_cast<double>(i) + Uniform(&random)) / static_cast<double>(num_samples);
    // The last triangle with area takes what rounding leaves beyond the end.
    while (area_up_to[triangle_idx] <= share * area && area_up_to[triangle_idx] < area) {
      ++triangle_idx;
    }
    samples.push_back(
        {PointInTriangle(mesh, triangle_idx, &random), static_cast<std::uint32_t>(triangle_idx)});
  }
  return samples;
}

}  // namespace plumb
