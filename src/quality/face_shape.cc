// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>

#include "plumbline/quality/quality_block.h"

namespace plumb {
namespace {

FaceShape ShapeOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  FaceShape shape;
  shape.center_in_map = (a + b + c) / 3.0;
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  const double length = cross.norm();
  if (!std::isfinite(length) || length == 0.0) return shape;
  shape.normal_in_map = cross / length;
  shape.area = 0.5 * length;
  return shape;
}

}  // namespace

std::vector<FaceShape> ShapesOf(const MeshBlock& block) {
  std::vector<FaceShape> shapes;
  shapes.reserve(block.faces.size());
  for (const auto& corner : block.faces) {
    shapes.push_back(ShapeOf(block.vertices[corner[0]].position_in_map,
                             block.vertices[corner[1]].position_in_map,
                             block.vertices[corner[2]].position_in_map));
  }
  return shapes;
}

}  // namespace plumb
