// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "plumbline/evaluation/distance_summary.h"
#include "plumbline/geometry/rigid3.h"

namespace plumb {
namespace {

constexpr double kClearance_m = 0.02;
constexpr double kMaxPieceSide_m = 1.0;

// Half the angle of the cone about the optical axis that holds the whole image.
double HalfAngleOfView(const Camera& camera) {
  double tangent = 0.0;
  for (const double x : {0.0, camera.width_px() - 1.0}) {
    for (const double y : {0.0, camera.height_px() - 1.0}) {
      const std::optional<Eigen::Vector2d> xy = camera.Unproject({x, y});
      if (!xy) return 0.5 * M_PI;
      tangent = std::max(tangent, xy->norm());
    }
  }
  return std::atan(tangent);
}

using Triangle = std::array<Eigen::Vector3d, 3>;

class PieceCutter {
 public:
  PieceCutter(const Camera& camera, const std::vector<TruePose>& photos)
      : half_angle_rad_(HalfAngleOfView(camera)), photos_(photos) {}

  void Cut(const Triangle& triangle) {
    const Eigen::Vector3d center = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    double radius_m = 0.0;
    for (const auto& vertex : triangle) radius_m = std::max(radius_m, (vertex - center).norm());
    if (!IsInView(center, radius_m)) return;
    int longest = 0;
    for (int i = 1; i < 3; ++i) {
      if (Side(triangle, i).norm() > Side(triangle, longest).norm()) longest = i;
    }
    if (Side(triangle, longest).norm() <= kMaxPieceSide_m) return Keep(triangle);
    const int next = (longest + 1) % 3;
    const Eigen::Vector3d middle = triangle[At(longest)] + 0.5 * Side(triangle, longest);
    Triangle half = triangle;
    half[At(next)] = middle;
    Cut(half);
    half = triangle;
    half[At(longest)] = middle;
    Cut(half);
  }

  TriangleMesh Take() { return std::move(pieces_); }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }

  static Eigen::Vector3d Side(const Triangle& triangle, int i) {
    return triangle[At((i + 1) % 3)] - triangle[At(i)];
  }

  bool IsInView(const Eigen::Vector3d& center, double radius_m) const {
    return std::any_of(photos_.begin(), photos_.end(), [&](const TruePose& photo) {
      const Eigen::Vector3d in_cam =
          photo.cam_from_world_rotation * (center - photo.center_in_world_m);
      const double distance_m = in_cam.norm();
      if (distance_m - radius_m > kMaxSeenDistance_m) return false;
      if (distance_m <= radius_m) return true;
      return std::acos(std::clamp(in_cam.z() / distance_m, -1.0, 1.0)) <=
             half_angle_rad_ + std::asin(radius_m / distance_m);
    });
  }

  void Keep(const Triangle& triangle) {
    const auto first = static_cast<std::uint32_t>(pieces_.vertices.size());
    pieces_.vertices.insert(pieces_.vertices.end(), triangle.begin(), triangle.end());
    pieces_.triangles.push_back({first, first + 1, first + 2});
  }

  double half_angle_rad_;
  const std::vector<TruePose>& photos_;
  TriangleMesh pieces_;
};

bool IsSeen(const Eigen::Vector3d& point_in_world,
            const MeshIndex& surface,
            const Camera& camera,
            const TruePose& photo) {
  const Eigen::Vector3d towards_camera = photo.center_in_world_m - point_in_world;
  const double distance_m = towards_camera.norm();
  if (distance_m <= kClearance_m || distance_m > kMaxSeenDistance_m) return false;
  const std::optional<Eigen::Vector2d> pixel =
      camera.Project(photo.cam_from_world_rotation * -towards_camera);
  if (!pixel || !camera.IsInImage(*pixel)) return false;
  return !surface.Blocks(point_in_world + kClearance_m / distance_m * towards_camera,
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

TriangleMesh PiecesInView(const TriangleMesh& mesh,
                          const Camera& camera,
                          const std::vector<TruePose>& photos) {
  PieceCutter cutter(camera, photos);
  for (const auto& corner : mesh.triangles) {
    cutter.Cut({mesh.vertices[corner[0]], mesh.vertices[corner[1]], mesh.vertices[corner[2]]});
  }
  return cutter.Take();
}

}  // namespace plumb
