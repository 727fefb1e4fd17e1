// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/rotation.h>

#include <Eigen/Core>

#include "plumbline/camera/projection.h"

namespace plumb {

// The lens as a parameter block: LensParameters, but with fy / fx in the place of fy.
constexpr int kAspect = kFy;

// Seen less projected centre, whitened. Blocks: lens (kNumLensParameters), pose (a rotation on top
// of `reference`, then the translation), centre.
struct CenterCost {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d sqrt_information;
  const Eigen::Matrix3d* reference;

  template <typename T>
  bool operator()(const T* lens, const T* pose, const T* center, T* residual) const {
    T turned[3];
    for (int i = 0; i < 3; ++i) {
      turned[i] = (*reference)(i, 0) * center[0] + (*reference)(i, 1) * center[1] +
                  (*reference)(i, 2) * center[2];
    }
    T in_cam[3];
    ceres::AngleAxisRotatePoint(pose, turned, in_cam);
    for (int i = 0; i < 3; ++i) in_cam[i] += pose[3 + i];
    if (!(in_cam[2] > 1e-6)) return false;
    T full[kNumLensParameters];
    for (int i = 0; i < kNumLensParameters; ++i) full[i] = lens[i];
    full[kFy] = lens[kFx] * lens[kAspect];
    T projected[2];
    ProjectToPixel(full, in_cam, projected);
    const T x = pixel.x() - projected[0];
    const T y = pixel.y() - projected[1];
    residual[0] = sqrt_information(0, 0) * x + sqrt_information(0, 1) * y;
    residual[1] = sqrt_information(1, 0) * x + sqrt_information(1, 1) * y;
    return true;
  }
};

// Holds single values near where they are expected: weight (value - expected).
template <int kSize>
struct PriorCost {
  Eigen::Matrix<double, kSize, 1> expected;
  Eigen::Matrix<double, kSize, 1> weight;

  template <typename T>
  bool operator()(const T* values, T* residual) const {
    for (int i = 0; i < kSize; ++i) residual[i] = weight(i) * (values[i] - expected(i));
    return true;
  }
};

// A centre near its place on a printed grid. Blocks: centre, sheet (stretch, shear).
struct PrintedCost {
  Eigen::Vector2d printed;
  double weight;

  template <typename T>
  bool operator()(const T* center, const T* sheet, T* residual) const {
    residual[0] = weight * (center[0] - printed.x() - sheet[1] * printed.y());
    residual[1] = weight * (center[1] - sheet[0] * printed.y());
    return true;
  }
};

}  // namespace plumb
