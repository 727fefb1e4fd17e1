// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/simulation/sensor.h"

namespace plumb {
namespace {

// Below it a Gaussian sampled at the pixels' centres is no longer what it should be.
constexpr double kSmallestSigma_px = 0.35;
constexpr double kMotionStep_px = 0.1;
constexpr double kRadiusInSigmas = 3.0;
constexpr double kMaxRadius_px = 100.0;

// A point on the optical axis at depth Z moves by -v - w x (0, 0, Z) each second.
Eigen::Vector2d Motion(const Camera& camera,
                       const Exposure& exposure,
                       const ShotConditions& conditions) {
  const Eigen::Vector3d& velocity = conditions.velocity_in_cam_m_s;
  const Eigen::Vector3d& rate = conditions.turn_rate_in_cam_rad_s;
  const double depth_m = conditions.scene_distance_m;
  const double right = -velocity.x() / depth_m - rate.y();
  const double down = -velocity.y() / depth_m + rate.x();
  return exposure.time_s * Eigen::Vector2d(camera.lens()[kFx] * right, camera.lens()[kFy] * down);
}

// Sigma of the disc of confusion, whose diameter is f^2 / N |d - s| / (d (s - f)) on the
// sensor for distance d and focus s (thin lens); a disc has the variance of diameter^2 / 16.
double DefocusSigma(const SensorOptions& options,
                    const Camera& camera,
                    const ShotConditions& conditions) {
  if (options.focus_distance_m == 0.0) return 0.0;
  const double focal_m = 1e-3 * conditions.focal_length_mm;
  const double focus_m = options.focus_distance_m;
  const double distance_m = conditions.scene_distance_m;
  const double diameter_m = focal_m * focal_m / options.f_number * std::abs(distance_m - focus_m) /
                            (distance_m * (focus_m - focal_m));
  return 0.25 * diameter_m * camera.MeanFocalLength() / focal_m;
}

// The mean of Gaussians along the way.
cv::Mat SpreadAlong(const Eigen::Vector2d& motion, double sigma) {
  const double reach = kRadiusInSigmas * sigma;
  const int radius_x = static_cast<int>(std::ceil(0.5 * std::abs(motion.x()) + reach));
  const int radius_y = static_cast<int>(std::ceil(0.5 * std::abs(motion.y()) + reach));
  const int num_steps = 1 + static_cast<int>(motion.norm() / kMotionStep_px);
  cv::Mat kernel = cv::Mat::zeros(2 * radius_y + 1, 2 * radius_x + 1, CV_32F);
  for (int step = 0; step < num_steps; ++step) {
    const Eigen::Vector2d center = motion * ((step + 0.5) / num_steps - 0.5);
    for (int y = -radius_y; y <= radius_y; ++y) {
      for (int x = -radius_x; x <= radius_x; ++x) {
        const double distance2 = (Eigen::Vector2d(x, y) - center).squaredNorm();
        kernel.at<float>(y + radius_y, x + radius_x) +=
            static_cast<float>(std::exp(-0.5 * distance2 / (sigma * sigma)));
      }
    }
  }
  return kernel / cv::sum(kernel)[0];
}

}  // namespace

cv::Mat BlurKernel(const SensorOptions& options,
                   const Camera& camera,
                   const Exposure& exposure,
                   const ShotConditions& conditions) {
  ThrowIfProblems("sensor", options.Problems());
  PLUMB_CHECK_GT(conditions.scene_distance_m, 0.0);
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();
  if (options.motion_blur) motion = Motion(camera, exposure, conditions);
  const double sigma = std::hypot(options.lens_blur_px, DefocusSigma(options, camera, conditions));
  if (sigma == 0.0 && motion.norm() < kMotionStep_px) return cv::Mat::ones(1, 1, CV_32F);
  motion *= std::min(1.0, kMaxRadius_px / std::max(motion.norm(), 1.0));
  return SpreadAlong(motion, std::clamp(sigma, kSmallestSigma_px, kMaxRadius_px / 3.0));
}

}  // namespace plumb
