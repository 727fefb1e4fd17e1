// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <optional>

#include "test/quality/quality_scene.h"

namespace plumb::test {

// What the quality of one face must be: every ray against every triangle, in double.
struct TrueQuality {
  int num_views = 0;
  int num_hidden = 0;
  double gsd = std::numeric_limits<double>::infinity();
};

// Moeller and Trumbore, Fast, minimum storage ray/triangle intersection, JGT 2(1), 1997.
inline std::optional<double> Intersect(const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction,
                                       const Corners& corners) {
  const Eigen::Vector3d edge1 = corners[1] - corners[0];
  const Eigen::Vector3d edge2 = corners[2] - corners[0];
  const Eigen::Vector3d p = direction.cross(edge2);
  const double determinant = edge1.dot(p);
  if (determinant == 0.0) return std::nullopt;
  const Eigen::Vector3d from_corner = origin - corners[0];
  const double u = from_corner.dot(p) / determinant;
  const Eigen::Vector3d q = from_corner.cross(edge1);
  const double v = direction.dot(q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
  return edge2.dot(q) / determinant;
}

// The longest distance on the face's plane between the ends of a pixel, whichever way the pixel is
// crossed: by casting the rays of pixels around it.
inline double TraceGsd(const Camera& camera,
                       const Rigid3& cam_from_map,
                       const Eigen::Vector3d& center,
                       const Eigen::Vector3d& normal) {
  const Rigid3 map_from_cam = cam_from_map.Inverse();
  const Eigen::Vector2d pixel = *camera.Project(cam_from_map * center);
  const auto on_plane = [&](const Eigen::Vector2d& at) {
    const Eigen::Vector3d ray = map_from_cam.rotation * camera.Unproject(at)->homogeneous();
    const double along = normal.dot(center - map_from_cam.translation) / normal.dot(ray);
    return Eigen::Vector3d(map_from_cam.translation + along * ray);
  };
  double longest = 0.0;
  for (int step = 0; step < 90; ++step) {
    const double angle = step * M_PI / 90.0;
    const Eigen::Vector2d half(0.05 * std::cos(angle), 0.05 * std::sin(angle));
    longest = std::max(longest, (on_plane(pixel + half) - on_plane(pixel - half)).norm() / 0.1);
  }
  return longest;
}

inline TrueQuality BruteForce(const Soup& soup,
                              std::size_t face,
                              const Camera& camera,
                              const std::vector<ViewState>& views) {
  const Corners& corners = soup[face];
  const Eigen::Vector3d center = (corners[0] + corners[1] + corners[2]) / 3.0;
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  TrueQuality quality;
  for (const ViewState& view : views) {
    const auto pixel = camera.Project(view.cam_from_map * center);
    if (!pixel || !camera.IsInImage(*pixel)) continue;
    const Eigen::Vector3d towards_eye = view.cam_from_map.TargetOriginInSource() - center;
    if (!(normal.dot(towards_eye) > 0.0)) continue;
    bool is_hidden = false;
    for (std::size_t other = 0; other < soup.size() && !is_hidden; ++other) {
      if (other == face) continue;
      const auto along = Intersect(center, towards_eye, soup[other]);
      is_hidden = along && *along > 0.0 && *along < 1.0;
    }
    if (is_hidden) {
      ++quality.num_hidden;
      continue;
    }
    ++quality.num_views;
    quality.gsd = std::min(quality.gsd, TraceGsd(camera, view.cam_from_map, center, normal));
  }
  return quality;
}

}  // namespace plumb::test
