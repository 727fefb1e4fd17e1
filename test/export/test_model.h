// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>

#include "plumbline/camera/camera.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

inline Camera MakeCamera(const std::vector<double>& distortion) {
  LensParameters<double> lens{};
  lens[kFx] = 812.5;
  lens[kFy] = 810.25;
  lens[kCx] = 321.75;
  lens[kCy] = 238.125;
  for (std::size_t i = 0; i < distortion.size(); ++i) lens[kK1 + i] = distortion[i];
  return {"test", 640, 480, DistortionModel::kRationalPolynomial, lens};
}

// Five cameras around 60 points; each sees every second point, at its exact pixel.
inline MapDelta MakeModel(const Camera& camera) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MapDelta snapshot;
  snapshot.is_snapshot = true;
  for (std::uint32_t i = 0; i < 60; ++i) {
    snapshot.landmarks_set.push_back({{3 * i},
                                      {uniform(random), uniform(random), uniform(random)},
                                      {static_cast<std::uint8_t>(i), 128, 255}});
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(0.1 * i - 0.2, Eigen::Vector3d::UnitY()));
    snapshot.views_set.push_back({{2 * i},
                                  "photo " + std::to_string(i) + ".jpg",
                                  {},
                                  Rigid3(rotation, {0.1 * i, 0.0, 6.0})});
    for (std::uint32_t k = i % 2; k < 60; k += 2) {
      const LandmarkState& landmark = snapshot.landmarks_set[k];
      const auto pixel =
          camera.Project(snapshot.views_set.back().cam_from_map * landmark.position_in_map);
      if (pixel)
        snapshot.observations_added.push_back({landmark.id, {2 * i}, k, pixel->cast<float>()});
    }
  }
  return snapshot;
}

}  // namespace plumb
