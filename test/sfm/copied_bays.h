// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "test/sfm/scene_photos.h"

namespace plumb::test {

// A long facade of bays that are exact copies, with photos of one row nearer to each other than the
// bays: moved by a bay, a photo overlaps its neighbour more than where it is.
struct CopiedBaysOptions {
  int num_bays = 7;
  double bay_width_m = 3.6;
  int points_per_bay = 90;
  int num_unique_points = 0;  // Spread over the whole facade.
  int num_cameras = 6;
  double spacing_m = 2.2;
  double distance_m = 6.0;
};

struct CopiedBays {
  Scene scene;
  std::vector<ScenePhoto> photos;
};

// Adds a camera's own view of the looks: the farther a point lies from the optical axis, the more
// its descriptor changes, as that of anything that stands out of the wall does. Seen at the same
// angle, two copies look more alike than one copy seen twice.
inline DescriptorMatrix LooksFrom(const Rigid3& cam_from_map,
                                  const std::vector<Eigen::Vector3d>& points_in_map,
                                  const std::vector<int>& look_of_point,
                                  const DescriptorMatrix& looks,
                                  const DescriptorMatrix& changes) {
  DescriptorMatrix seen(static_cast<Eigen::Index>(points_in_map.size()), kDescriptorSize);
  for (std::size_t i = 0; i < points_in_map.size(); ++i) {
    const Eigen::Vector3d in_cam = cam_from_map * points_in_map[i];
    const double change = std::clamp(in_cam.x() / in_cam.z(), -1.0, 1.0);
    const auto look = static_cast<Eigen::Index>(look_of_point[i]);
    for (Eigen::Index k = 0; k < kDescriptorSize; ++k) {
      const double value = looks(look, k) + 0.35 * change * (changes(look, k) - 40.0);
      seen(static_cast<Eigen::Index>(i), k) =
          static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return seen;
}

inline CopiedBays MakeCopiedBays(const CopiedBaysOptions& options) {
  Random random(3);
  Scene scene{MakeCamera(), {}, {}, {}};
  std::vector<int> look_of_point;
  const double width_m = options.num_bays * options.bay_width_m;
  for (int p = 0; p < options.points_per_bay; ++p) {
    const double x_m = random.Uniform(0.0, options.bay_width_m);
    const double y_m = random.Uniform(-0.3, 0.3);
    const double z_m = random.Uniform(-3.0, 3.0);
    for (int bay = 0; bay < options.num_bays; ++bay) {
      scene.points_in_map.emplace_back(x_m + bay * options.bay_width_m, y_m, z_m);
      look_of_point.push_back(p);
    }
  }
  for (int u = 0; u < options.num_unique_points; ++u) {
    const double x_m = random.Uniform(0.0, width_m);
    const double y_m = random.Uniform(-0.3, 0.3);
    scene.points_in_map.emplace_back(x_m, y_m, random.Uniform(-3.0, 3.0));
    look_of_point.push_back(options.points_per_bay + u);
  }
  const int num_looks = options.points_per_bay + options.num_unique_points;
  const DescriptorMatrix looks = RandomDescriptors(num_looks, 4);
  const DescriptorMatrix changes = RandomDescriptors(num_looks, 5);
  SceneOptions observed;
  observed.noise_px = 0.3;
  std::vector<ScenePhoto> photos;
  for (int k = 0; k < options.num_cameras; ++k) {
    const double middle = k - 0.5 * (options.num_cameras - 1);
    const Eigen::Vector3d center(
        0.5 * width_m + middle * options.spacing_m, -options.distance_m, 0.1 * (k % 3));
    const Rigid3 cam_from_map{FacingFacade(), -(FacingFacade() * center)};
    scene.cams_from_map.push_back(cam_from_map);
    scene.observations.emplace_back();
    for (std::size_t i = 0; i < scene.points_in_map.size(); ++i) {
      auto seen = Observe(observed, cam_from_map, scene.points_in_map[i], &random);
      if (!seen) continue;
      seen->point_idx = static_cast<int>(i);
      scene.observations.back().push_back(*seen);
    }
    photos.push_back(MakeScenePhoto(
        scene,
        static_cast<std::size_t>(k),
        LooksFrom(cam_from_map, scene.points_in_map, look_of_point, looks, changes)));
  }
  return {std::move(scene), std::move(photos)};
}

}  // namespace plumb::test
