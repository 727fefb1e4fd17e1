// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/visibility.h"

#include <optional>

#include "plumbline/evaluation/distance_summary.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {
namespace {

constexpr double kClearance_m = 0.02;

bool IsSeen(const Eigen::Vector3d& point_in_world,
            const MeshIndex& surface,
            const Camera& camera,
            const TruePose& photo) {
  const Eigen::Vector3d towards_camera = photo.center_in_world_m - point_in_world;
  const std::optional<Eigen::Vector2d> pixel =
      camera.Project(photo.cam_from_world_rotation * -towards_camera);
  if (!pixel || !camera.IsInImage(*pixel)) return false;
  const double distance_m = towards_camera.norm();
  return distance_m > kClearance_m &&
         !surface.Blocks(point_in_world + kClearance_m / distance_m * towards_camera,
                         photo.center_in_world_m);
}

}  // namespace

std::vector<Eigen::Vector3d> PointsSeen(const std::vector<Eigen::Vector3d>& points_in_world,
                                        const MeshIndex& surface,
                                        const Camera& camera,
                                        const std::vector<TruePose>& photos,
                                        int min_photos) {
  const std::vector<double> num_photos =
      EvaluateAtPoints(points_in_world, [&](const Eigen::Vector3d& point) {
        int seen = 0;
        for (const TruePose& photo : photos) {
          if (seen < min_photos && IsSeen(point, surface, camera, photo)) ++seen;
        }
        return static_cast<double>(seen);
      });
  std::vector<Eigen::Vector3d> points_seen;
  for (std::size_t i = 0; i < points_in_world.size(); ++i) {
    if (num_photos[i] >= min_photos) points_seen.push_back(points_in_world[i]);
  }
  return points_seen;
}

}  // namespace plumb
