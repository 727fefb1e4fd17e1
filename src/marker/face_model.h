// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace plumb {

// How white a blurred marker is at a point, 0 to 1, and how that changes.
struct Whiteness {
  double value = 0.0;
  Eigen::Vector2d by_point = Eigen::Vector2d::Zero();  // Per outer radius.
  double by_blur = 0.0;                                // Per unit of blur.
  double by_growth = 0.0;                              // Per unit of growth.
};

// What the photo does to the edges [px].
struct EdgeLook {
  double blur = 0.0;    // Sigma of a Gaussian.
  double growth = 0.0;  // By how much white has grown over black.
};

// The face as the photo shows it, where `marker_from_pixel` is the derivative of marker coordinates
// by pixels. Edges are straight within the blur's reach, and the code's cells the product of their
// radial and their tangential edges.
Whiteness BlurredFace(std::uint32_t word,
                      const Eigen::Vector2d& point_in_marker,
                      const Eigen::Matrix2d& marker_from_pixel,
                      const EdgeLook& look);

}  // namespace plumb
