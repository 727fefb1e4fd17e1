// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/simulation/sensor.h"

namespace plumb {
namespace {

// Metering looks at every so-manyth pixel of each axis.
constexpr int kMeteringStep = 8;

// Brightest radiance that metering counts: a mirror of the sun must not darken the facade.
constexpr double kBrightestMetered = 2.0;

// The "sunny 16" rule: at f/16, 1/ISO seconds show a white surface in the sun as white.
double Gain(const SensorOptions& options, double time_s, double iso) {
  const double stop = 16.0 / options.f_number;
  return options.daylight * time_s * iso * stop * stop;
}

// The next lower third of a stop.
double DownToThird(double ratio) { return std::exp2(std::floor(3.0 * std::log2(ratio)) / 3.0); }

// Luminance (ITU-R BT.709), weighed by a bell over the photo's middle.
double MeteredMean(const cv::Mat& radiance) {
  double sum = 0.0;
  double sum_weights = 0.0;
  for (int y = 0; y < radiance.rows; y += kMeteringStep) {
    for (int x = 0; x < radiance.cols; x += kMeteringStep) {
      const auto& bgr = radiance.at<cv::Vec3f>(y, x);
      const double right = 2.0 * x / radiance.cols - 1.0;
      const double down = 2.0 * y / radiance.rows - 1.0;
      const double weight = std::exp(-(right * right + down * down));
      const double luminance = 0.0722 * bgr[0] + 0.7152 * bgr[1] + 0.2126 * bgr[2];
      sum += weight * std::clamp(luminance, 0.0, kBrightestMetered);
      sum_weights += weight;
    }
  }
  return sum / sum_weights;
}

}  // namespace

Exposure MeterExposure(const SensorOptions& options, const cv::Mat& radiance) {
  ThrowIfProblems("sensor", options.Problems());
  PLUMB_CHECK(radiance.type() == CV_32FC3 && !radiance.empty());
  Exposure exposure{options.max_exposure_s, options.min_iso, 0.0};
  if (options.auto_exposure) {
    const double darkest = Gain(options, options.max_exposure_s, options.min_iso);
    const double wanted = options.metering_target / std::max(MeteredMean(radiance), 1e-6) / darkest;
    const double ratio = DownToThird(wanted);
    exposure.time_s *= std::min(ratio, 1.0);
    const double iso = options.min_iso * std::max(ratio, 1.0);
    exposure.iso = static_cast<int>(std::lround(std::min<double>(iso, options.max_iso)));
  }
  exposure.gain = Gain(options, exposure.time_s, exposure.iso);
  return exposure;
}

}  // namespace plumb
