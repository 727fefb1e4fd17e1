// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/true_poses.h"

namespace plumb {

// Those of `points` that at least `min_photos` of the photos show: within the image, and nothing
// of the surface in between. The last 2 cm before the point do not hide it, for a scanned point
// lies off the surface by its noise.
std::vector<Eigen::Vector3d> PointsSeen(const std::vector<Eigen::Vector3d>& points_in_world,
                                        const MeshIndex& surface,
                                        const Camera& camera,
                                        const std::vector<TruePose>& photos,
                                        int min_photos);

}  // namespace plumb
