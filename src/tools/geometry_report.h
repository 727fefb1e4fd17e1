// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/evaluation/triangle_mesh.h"
#include "plumbline/evaluation/true_poses.h"
#include "plumbline/evaluation/wall_bend.h"

namespace plumb::tools {

// What the reconstructed points are held against.
struct GeometryTruth {
  std::string surface;          // PLY of a mesh; empty: none.
  std::string laser;            // PLY of a point cloud; empty: none.
  std::size_t num_samples = 0;  // Of each truth, at most.
  WallBendOptions wall;
  std::vector<TruePose> photos;  // And their camera: completeness counts what they show.
};

// Adds to `report`, for each truth that is given, "surface" and "laser": accuracy, completeness,
// both as summaries of one-way distances, and F-score; and "wall", the bend of the surface's faces
// marked as main_wall, null if there are none or too few points on them. Throws std::runtime_error
// naming the file that is unusable, or if there are no points.
void ReportGeometry(const GeometryTruth& truth,
                    const Camera& camera,
                    const std::vector<Eigen::Vector3d>& points_in_world,
                    nlohmann::ordered_json* report);

// Adds "mesh" to `report`: the same of a reconstructed mesh, under "surface" and "laser". Its
// accuracy is that of points spread evenly over its area. Throws std::runtime_error as above, or if
// the mesh has no area.
void ReportMesh(const GeometryTruth& truth,
                const Camera& camera,
                const TriangleMesh& mesh_in_world,
                nlohmann::ordered_json* report);

}  // namespace plumb::tools
