// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "test/support/random.h"

namespace plumb::test {

// 12 megapixels, 77 degrees wide, without distortion unless a lens is given.
inline Camera MakeCamera(double k1 = 0.0, double k2 = 0.0, double p1 = 0.0, double p2 = 0.0) {
  return Camera("synthetic",
                4000,
                3000,
                DistortionModel::kPlumbBob,
                {2500.0, 2500.0, 1999.5, 1499.5, k1, k2, p1, p2, 0.0, 0.0, 0.0, 0.0});
}

struct SceneOptions {
  int num_points = 500;
  double width_m = 16.0;   // Of the facade, along x of the map; its centre is the origin.
  double height_m = 10.0;  // Along z, up.
  double relief_m = 1.0;   // Points lie up to so far before and behind the plane y = 0.

  int num_cameras = 2;
  double distance_m = 10.0;   // The cameras stand in a row at y = -distance_m ...
  double spacing_m = 1.5;     // ... along x, so far apart, centred on the facade ...
  double approach_m = 0.0;    // ... each so much nearer to it than the one before ...
  double max_turn_rad = 0.1;  // ... turned by up to so much off the facade's normal, each axis.

  double noise_px = 0.0;       // Standard deviation of x and of y.
  double outlier_ratio = 0.0;  // Observations replaced by a random pixel of the image.
  int random_seed = 1;
  Camera camera = MakeCamera();
};

struct SceneObservation {
  int point_idx;
  Eigen::Vector2d pixel;
  Eigen::Vector2d xy;  // Of the ray of `pixel`.
  bool is_outlier;
};

// A facade before which cameras hover in a row.
struct Scene {
  Camera camera;
  std::vector<Eigen::Vector3d> points_in_map;
  std::vector<Rigid3> cams_from_map;
  std::vector<std::vector<SceneObservation>> observations;  // Per camera; only within the image.
};

// Camera frame of a camera that looks along y of the map with z up, before it is turned.
inline Eigen::Quaterniond FacingFacade() {
  Eigen::Matrix3d cam_from_map;
  cam_from_map << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return Eigen::Quaterniond(cam_from_map);
}

inline Rigid3 MakeScenePose(const SceneOptions& options, int camera_idx, Random* random) {
  const double steps = camera_idx - 0.5 * (options.num_cameras - 1);
  const Eigen::Vector3d center(steps * options.spacing_m,
                               -options.distance_m + camera_idx * options.approach_m,
                               0.05 * options.spacing_m * (camera_idx % 3));
  const Eigen::Vector3d turn = random->InBox(options.max_turn_rad);
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()) *
                                      Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()) *
                                      FacingFacade();
  return {rotation, -(rotation * center)};
}

// What a camera sees of a point; nothing if it is not in the image.
inline std::optional<SceneObservation> Observe(const SceneOptions& options,
                                               const Rigid3& cam_from_map,
                                               const Eigen::Vector3d& point_in_map,
                                               Random* random) {
  const Camera& camera = options.camera;
  SceneObservation observation = {};
  const Eigen::Vector2d noise = random->Normal2(options.noise_px);
  observation.is_outlier = random->Uniform(0.0, 1.0) < options.outlier_ratio;
  const double x_px = random->Uniform(0.0, camera.width_px() - 1.0);
  const Eigen::Vector2d anywhere(x_px, random->Uniform(0.0, camera.height_px() - 1.0));
  const auto pixel = camera.Project(cam_from_map * point_in_map);
  if (!pixel) return std::nullopt;
  observation.pixel = observation.is_outlier ? anywhere : Eigen::Vector2d(*pixel + noise);
  if (!camera.IsInImage(*pixel) || !camera.IsInImage(observation.pixel)) return std::nullopt;
  const auto xy = camera.Unproject(observation.pixel);
  if (!xy) return std::nullopt;
  observation.xy = *xy;
  return observation;
}

inline Scene MakeScene(const SceneOptions& options = {}) {
  Random random(options.random_seed);
  Scene scene{options.camera, {}, {}, {}};
  for (int i = 0; i < options.num_points; ++i) {
    const double x = random.Uniform(-0.5 * options.width_m, 0.5 * options.width_m);
    const double y = random.Uniform(-options.relief_m, options.relief_m);
    const double z = random.Uniform(-0.5 * options.height_m, 0.5 * options.height_m);
    scene.points_in_map.emplace_back(x, y, z);
  }
  for (int k = 0; k < options.num_cameras; ++k) {
    const Rigid3 cam_from_map = MakeScenePose(options, k, &random);
    scene.cams_from_map.push_back(cam_from_map);
    scene.observations.emplace_back();
    for (int i = 0; i < options.num_points; ++i) {
      auto observation =
          Observe(options, cam_from_map, scene.points_in_map[static_cast<std::size_t>(i)], &random);
      if (!observation) continue;
      observation->point_idx = i;
      scene.observations.back().push_back(*observation);
    }
  }
  return scene;
}

// Observations of the points that both of two cameras see.
struct SceneMatches {
  std::vector<Eigen::Vector2d> xy1;
  std::vector<Eigen::Vector2d> xy2;
  std::vector<int> point_idx;
  std::vector<char> is_outlier;  // In either view.
};

inline SceneMatches MatchScene(const Scene& scene, std::size_t camera1, std::size_t camera2) {
  SceneMatches matches;
  auto second = scene.observations[camera2].begin();
  const auto end = scene.observations[camera2].end();
  for (const SceneObservation& first : scene.observations[camera1]) {
    while (second != end && second->point_idx < first.point_idx) ++second;
    if (second == end || second->point_idx != first.point_idx) continue;
    matches.xy1.push_back(first.xy);
    matches.xy2.push_back(second->xy);
    matches.point_idx.push_back(first.point_idx);
    matches.is_outlier.push_back(first.is_outlier || second->is_outlier ? 1 : 0);
  }
  return matches;
}

inline Rigid3 RelativePose(const Scene& scene, std::size_t camera1, std::size_t camera2) {
  return scene.cams_from_map[camera2] * scene.cams_from_map[camera1].Inverse();
}

}  // namespace plumb::test
