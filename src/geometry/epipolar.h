// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

// A match of two normalised observations.
struct NormalizedMatch {
  Eigen::Vector2d xy1;
  Eigen::Vector2d xy2;
};

// Square of SampsonError of relative_pose.h.
inline double SquaredSampsonError(const Eigen::Matrix3d& e,
                                  const Eigen::Vector2d& xy1,
                                  const Eigen::Vector2d& xy2) {
  const double line2_x = e(0, 0) * xy1.x() + e(0, 1) * xy1.y() + e(0, 2);
  const double line2_y = e(1, 0) * xy1.x() + e(1, 1) * xy1.y() + e(1, 2);
  const double line2_w = e(2, 0) * xy1.x() + e(2, 1) * xy1.y() + e(2, 2);
  const double line1_x = e(0, 0) * xy2.x() + e(1, 0) * xy2.y() + e(2, 0);
  const double line1_y = e(0, 1) * xy2.x() + e(1, 1) * xy2.y() + e(2, 1);
  const double value = xy2.x() * line2_x + xy2.y() * line2_y + line2_w;
  const double slope2 =
      line2_x * line2_x + line2_y * line2_y + line1_x * line1_x + line1_y * line1_y;
  return slope2 > 0.0 ? value * value / slope2 : 0.0;  // Both rays along the baseline.
}

// The four poses cam2_from_cam1, |translation| = 1, with this essential matrix up to sign.
std::array<Rigid3, 4> PosesFromEssential(const Eigen::Matrix3d& essential);

// cam2_from_cam1, |translation| = 1, that minimises the sum of huber(Sampson error), from
// `initial`.
Rigid3 MinimizeSampsonError(const Rigid3& initial,
                            const std::vector<NormalizedMatch>& matches,
                            double huber_width,
                            int max_iterations);

// Standard deviations of a relative pose: those of the least certain turn and of the least certain
// move of the translation's direction. Infinite where the matches do not fix the pose.
struct RelativePoseSigmas {
  double turn_rad = 0.0;
  double direction_rad = 0.0;
};

// By the normal equations of the Sampson errors at the pose that minimises them, for matches whose
// errors have the standard deviation `error_sigma`.
RelativePoseSigmas SigmasOf(const Rigid3& cam2_from_cam1,
                            const std::vector<NormalizedMatch>& matches,
                            double error_sigma);

}  // namespace plumb
