// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/triangle_mesh.h"
#include "plumbline/evaluation/true_poses.h"

namespace plumb {

// What is farther from the camera is background, not what was flown for.
constexpr double kMaxSeenDistance_m = 20.0;

// Those of `points` that at least `min_photos` of the photos show: within the image and
// kMaxSeenDistance_m, and nothing of the surface in between. The last 2 cm before the point do not
// hide it, for a scanned point lies off the surface by its noise.
std::vector<Eigen::Vector3d> PointsSeen(const std::vector<Eigen::Vector3d>& points_in_world,
                                        const MeshIndex& surface,
                                        const Camera& camera,
                                        const std::vector<TruePose>& photos,
                                        int min_photos);

// The mesh cut into pieces of at most 1 m, without those that lie in no photo's cone of view: all
// of what PointsSeen can find, so that few samples of it are lost.
TriangleMesh PiecesInView(const TriangleMesh& mesh,
                          const Camera& camera,
                          const std::vector<TruePose>& photos);

}  // namespace plumb
