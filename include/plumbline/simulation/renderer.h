// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/simulation/world.h"

namespace plumb {

struct Light {
  Eigen::Vector3d towards_sun_in_world{-0.45, -0.65, 0.61};  // Normalised where it is used.
  double sun_irradiance = 1.0;  // On a surface that faces the sun; white then has radiance 1.
  double sky_irradiance = 0.35;
};

// What the ray through a pixel meets.
struct RayHit {
  Eigen::Vector3d point_in_world;
  Eigen::Vector3d normal_in_world;  // Outward, unit length.
  double distance_m = 0.0;
  int triangle = -1;  // Into World::triangles; -1 for a plate.
  int plate = -1;     // Into World::plates; -1 for a triangle.
};

// Ray casts photos of a world (Embree). Holds its own copy of what it needs; rendering is
// deterministic whatever the number of threads. Thread-safe: const methods hold no mutable state.
class Renderer {
 public:
  // Throws std::invalid_argument if an index of `world` is out of range or a vertex is not finite.
  explicit Renderer(const World& world);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Linear radiance, CV_32FC3 in the order B, G, R, of the camera's size; distortion exactly as
  // `camera` has it; every pixel the mean over samples_per_axis^2 places of its area. The pixel (0,
  // 0) is centred on the ray of raw pixel (0, 0). num_threads 0: all cores.
  cv::Mat Render(const Camera& camera,
                 const Rigid3& cam_from_world,
                 const Light& light,
                 int samples_per_axis = 2,
                 int num_threads = 0) const;

  // The first thing that a ray meets; nothing if it meets the sky. The direction need not be
  // of unit length.
  std::optional<RayHit> Cast(const Eigen::Vector3d& origin_in_world,
                             const Eigen::Vector3d& direction_in_world) const;

  // Whether nothing lies between two points (ends pulled in by 0.1 mm).
  bool IsVisible(const Eigen::Vector3d& from_in_world, const Eigen::Vector3d& to_in_world) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
