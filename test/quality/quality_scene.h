// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_delta.h"
#include "plumbline/surface/mesh_delta.h"

namespace plumb::test {

using Corners = std::array<Eigen::Vector3d, 3>;

// A mesh as triangles, each with landmarks of its own.
using Soup = std::vector<Corners>;

// The cube of a face, of side 1.
inline BlockId BlockOf(const Corners& corners) {
  const Eigen::Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
  const auto floor = [](double value) { return static_cast<std::int32_t>(std::floor(value)); };
  return {floor(center.x()), floor(center.y()), floor(center.z())};
}

inline void AppendFace(const Corners& corners, std::uint32_t first_landmark, MeshBlock* block) {
  const auto first = static_cast<std::uint32_t>(block->vertices.size());
  for (std::uint32_t k = 0; k < 3; ++k) {
    block->vertices.push_back({LandmarkId{first_landmark + k}, corners[k], {0, 0, 0}});
  }
  block->faces.push_back({first, first + 1, first + 2});
}

// Landmark ids come from the face's place in the soup.
inline MeshDelta SnapshotOf(const Soup& soup) {
  std::map<BlockId, MeshBlock> blocks;
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    MeshBlock& block = blocks[BlockOf(soup[i])];
    block.id = BlockOf(soup[i]);
    AppendFace(soup[i], 3 * i, &block);
  }
  MeshDelta delta;
  delta.is_snapshot = true;
  for (auto& [id, block] : blocks) delta.blocks.push_back(std::move(block));
  return delta;
}

// A rectangle as a grid of pairs of triangles that face side1 x side2.
inline void AddGrid(const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& side1,
                    const Eigen::Vector3d& side2,
                    int num1,
                    int num2,
                    Soup* soup) {
  for (int i = 0; i < num1; ++i) {
    for (int j = 0; j < num2; ++j) {
      const Eigen::Vector3d a = corner + side1 * i / num1 + side2 * j / num2;
      const Eigen::Vector3d b = a + side1 / num1;
      const Eigen::Vector3d d = a + side2 / num2;
      soup->push_back({a, b, b + side2 / num2});
      soup->push_back({a, b + side2 / num2, d});
    }
  }
}

// From a camera at `eye` that looks at `target`, upright where z is up.
inline Rigid3 LookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d cam_from_map;
  cam_from_map << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return {Eigen::Quaterniond(cam_from_map), -(cam_from_map * eye)};
}

inline ViewState MakeView(std::uint32_t photo, const Rigid3& cam_from_map) {
  ViewState view;
  view.photo = PhotoId{photo};
  view.cam_from_map = cam_from_map;
  return view;
}

// A photo of 600 x 400 px, 62 degrees wide, with a lens that bends as that of the simulation does.
inline Camera SmallCamera() {
  LensParameters<double> lens = {500.0, 500.0, 302.0, 198.0, -0.072, 0.041, 0.0004, -0.0003};
  return Camera("small", 600, 400, DistortionModel::kPlumbBob, lens);
}

}  // namespace plumb::test
