// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

// A grey value; the place is relative to somewhere near the marker [px].
struct FaceSample {
  Eigen::Vector2d place_px;
  double gray = 0.0;
};

struct FaceFit {
  Eigen::Matrix3d pixel_from_marker;  // Last entry 1, so that its last column is the centre.
  Eigen::Matrix2d center_covariance_px2;
  double contrast = 0.0;   // Of white over black [grey levels].
  double blur_px = 0.0;    // Sigma.
  double explained = 0.0;  // Share of the grey values' variance.
};

// Lays the marker's face over the photo: least squares on the grey values (Huber's norm) over
// the homography, the blur, the growth of white that a tone curve or the print makes, black, white,
// and a gradient of the light. Its centre is that of the
// marker's frame and so free of the perspective's bias. `perspective_sigma`: standard deviation
// expected of the homography's lower left entries; keeps small markers from inventing a tilt.
// Nothing if it does not converge near `pixel_from_marker`.
std::optional<FaceFit> FitFace(const std::vector<FaceSample>& samples,
                               std::uint32_t word,
                               const Eigen::Matrix3d& pixel_from_marker,
                               double perspective_sigma);

}  // namespace plumb
