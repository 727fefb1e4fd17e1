// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/simulation/sensor_options.h"

namespace plumb {

// How the camera stands to the light in one photo.
struct Exposure {
  double time_s = 0.0;
  int iso = 0;
  double gain = 0.0;  // Value in the file, linear, 1 is white, of radiance 1.
};

// What blurs a photo, and the number that its noise is drawn from.
struct ShotConditions {
  Eigen::Vector3d velocity_in_cam_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rate_in_cam_rad_s = Eigen::Vector3d::Zero();
  double scene_distance_m = 10.0;  // Along the optical axis.
  double focal_length_mm = 16.0;   // Of the lens, for its circle of confusion.
  std::uint64_t noise_seed = 0;    // Another one for each photo.
};

// What the camera writes beside the picture.
struct PhotoTags {
  Timestamp exposure_time;
  double focal_length_mm = 16.0;
  double focal_length_35mm = 24.0;
  std::optional<GeodeticPosition> position;
};

// Radiances are linear, CV_32FC3 in the order B, G, R, 1 is white in the sun. All throw
// std::invalid_argument listing options.Problems().

// Centre-weighted metering, darkest and brightest bounded by the options.
Exposure MeterExposure(const SensorOptions& options, const cv::Mat& radiance);

// Weights of what a point of the scene is spread over, centred on the middle of the exposure:
// CV_32FC1, odd size, of sum 1. One for the whole photo: that of its middle.
cv::Mat BlurKernel(const SensorOptions& options,
                   const Camera& camera,
                   const Exposure& exposure,
                   const ShotConditions& conditions);

// The picture in 8 bits, CV_8UC3 in the order B, G, R: vignetting, blur, shot and read noise,
// tone curve. The same whatever the number of threads (0: all cores).
cv::Mat ExposePhoto(const SensorOptions& options,
                    const Camera& camera,
                    const cv::Mat& radiance,
                    const Exposure& exposure,
                    const ShotConditions& conditions,
                    int num_threads = 0);

// The file: JPEG with EXIF.
std::vector<std::uint8_t> EncodePhoto(const SensorOptions& options,
                                      const cv::Mat& picture,
                                      const Exposure& exposure,
                                      const PhotoTags& tags);

}  // namespace plumb
