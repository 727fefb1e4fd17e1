// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace plumb {

// Order of the parameters of a lens: pinhole first, then distortion.
enum LensParameter {
  kFx,
  kFy,
  kCx,
  kCy,
  kK1,
  kK2,
  kP1,
  kP2,
  kK3,
  kK4,
  kK5,
  kK6,
  kNumLensParameters
};

// ROS plumb_bob is the rational model with k4 = k5 = k6 = 0.
template <typename T>
using LensParameters = std::array<T, kNumLensParameters>;

// Distorts normalised image coordinates (x, y) = (X/Z, Y/Z). Brown's model in
// the rational form of OpenCV ("Camera Calibration and 3D Reconstruction"):
//   r2 = x^2 + y^2
//   g  = (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)
//   x' = g x + 2 p1 x y + p2 (r2 + 2 x^2)
//   y' = g y + p1 (r2 + 2 y^2) + 2 p2 x y
// `lens` points to kNumLensParameters values. L is double or T; T may be a Ceres Jet.
template <typename L, typename T>
void Distort(const L* lens, const T& x, const T& y, T* distorted_x, T* distorted_y) {
  const T r2 = x * x + y * y;
  const T numerator = 1.0 + r2 * (lens[kK1] + r2 * (lens[kK2] + r2 * lens[kK3]));
  const T denominator = 1.0 + r2 * (lens[kK4] + r2 * (lens[kK5] + r2 * lens[kK6]));
  const T radial = numerator / denominator;
  *distorted_x = radial * x + 2.0 * lens[kP1] * x * y + lens[kP2] * (r2 + 2.0 * x * x);
  *distorted_y = radial * y + lens[kP1] * (r2 + 2.0 * y * y) + 2.0 * lens[kP2] * x * y;
}

// Projects a point in the camera frame to raw pixels; pixel (0, 0) is the
// top-left pixel's centre. The caller ensures a positive depth.
template <typename L, typename T>
void ProjectToPixel(const L* lens, const T* point_in_cam, T* pixel) {
  const T x = point_in_cam[0] / point_in_cam[2];
  const T y = point_in_cam[1] / point_in_cam[2];
  T distorted_x;
  T distorted_y;
  Distort(lens, x, y, &distorted_x, &distorted_y);
  pixel[0] = lens[kFx] * distorted_x + lens[kCx];
  pixel[1] = lens[kFy] * distorted_y + lens[kCy];
}

}  // namespace plumb
