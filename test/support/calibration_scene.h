// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/calibration/calibration_photo.h"
#include "plumbline/camera/camera.h"
#include "test/support/random.h"

namespace plumb::test {

// The paper's camera, at 2000 px: 16 mm on APS-C.
inline LensParameters<double> CalibrationLens() {
  return {1361.7, 1361.7, 1002.9, 664.0, -0.072, 0.041, 0.0004, -0.0003, 0.0, 0.0, 0.0, 0.0};
}

inline Camera CalibrationCamera(const LensParameters<double>& lens = CalibrationLens(),
                                int width_px = 2000,
                                int height_px = 1333) {
  const bool is_rational = lens[kK4] != 0.0 || lens[kK5] != 0.0 || lens[kK6] != 0.0;
  return Camera("truth",
                width_px,
                height_px,
                is_rational ? DistortionModel::kRationalPolynomial : DistortionModel::kPlumbBob,
                lens);
}

// A coded marker where it lies; lengths in marker diameters, z up.
struct ScenePlate {
  int id = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double angle_rad = 0.0;  // Of its x axis.
};

struct CalibrationSceneOptions {
  Camera camera = CalibrationCamera();
  int num_photos = 12;
  double max_tilt_deg = 45.0;
  double min_fill = 0.6;  // Of the photo's width by the markers: how near the camera is.
  double max_fill = 1.2;
  bool turns_camera = true;  // By quarters about its axis, from photo to photo.
  double noise_factor = 1.0;
  double hidden_share = 0.0;  // Of the markers in each photo.
  int random_seed = 1;
};

// 4 x 4 places 3.5 diameters apart, each off by up to 0.7, turned at random.
inline std::vector<ScenePlate> StrewnPlates(Random* random, int per_side = 4) {
  std::vector<ScenePlate> plates;
  for (int i = 0; i < per_side * per_side; ++i) {
    ScenePlate plate;
    plate.id = i;
    const double x = 3.5 * (i % per_side - 0.5 * (per_side - 1)) + random->Uniform(-0.7, 0.7);
    const double y = 3.5 * (i / per_side - 0.5 * (per_side - 1)) + random->Uniform(-0.7, 0.7);
    plate.center << x, y, 0.0;
    plate.angle_rad = random->Uniform(-3.1, 3.1);
    plates.push_back(plate);
  }
  return plates;
}

// Photo k of a round about the markers: tilts, directions and distances change independently.
inline Rigid3 CalibrationPose(const CalibrationSceneOptions& options,
                              double extent,
                              int photo_idx,
                              Random* random) {
  const double share = (photo_idx * 7 % 12) / 11.0;
  const double tilt =
      options.max_tilt_deg * M_PI / 180.0 * std::sqrt(share) + random->Uniform(-0.05, 0.05);
  const double azimuth = 2.4 * photo_idx + random->Uniform(-0.2, 0.2);
  const double fill =
      options.min_fill + (options.max_fill - options.min_fill) * ((photo_idx * 5 % 12) / 11.0);
  const Camera& camera = options.camera;
  const double distance = extent * camera.lens()[kFx] / (fill * camera.width_px());
  const double quarter = options.turns_camera ? 0.5 * M_PI * (photo_idx % 4) : 0.0;
  const Eigen::Quaterniond rotation =
      Eigen::AngleAxisd(quarter + random->Uniform(-0.1, 0.1), Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)) *
      Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);  // Looks down: x right, y down, z forward.
  const Eigen::Vector3d aim(
      random->Uniform(-0.15, 0.15) * extent, random->Uniform(-0.15, 0.15) * extent, 0.0);
  return {rotation, Eigen::Vector3d(0.0, 0.0, distance) - rotation * aim};
}

// What a detector without noise would give of a plate; nothing if it is not wholly in the image.
inline std::optional<MarkerDetection> SeePlate(const Camera& camera,
                                               const Rigid3& cam_from_plane,
                                               const ScenePlate& plate) {
  const auto project = [&](double along, double across) -> std::optional<Eigen::Vector2d> {
    const double c = std::cos(plate.angle_rad);
    const double s = std::sin(plate.angle_rad);
    // The marker's y points down as printed, against z x x.
    const Eigen::Vector3d offset(c * along + s * across, s * along - c * across, 0.0);
    const auto pixel = camera.Project(cam_from_plane * (plate.center + offset));
    if (!pixel || !camera.IsInImage(*pixel)) return std::nullopt;
    return pixel;
  };
  for (int i = 0; i < 12; ++i) {
    const double angle = i * M_PI / 6.0;
    if (!project(0.625 * std::cos(angle), 0.625 * std::sin(angle))) return std::nullopt;
  }
  constexpr double kStep = 1e-4;
  const Eigen::Vector2d center = *project(0.0, 0.0);
  Eigen::Matrix2d affine;  // Per radius, which is half a diameter.
  affine << 0.5 * (*project(kStep, 0.0) - *project(-kStep, 0.0)) / (2.0 * kStep),
      0.5 * (*project(0.0, kStep) - *project(0.0, -kStep)) / (2.0 * kStep);
  MarkerDetection detection;
  detection.id = plate.id;
  detection.center_px = center;
  detection.ellipse = EllipseOfAffine(center, affine);
  detection.pixel_from_marker.topLeftCorner<2, 2>() = affine;
  detection.pixel_from_marker.topRightCorner<2, 1>() = center;
  detection.probability = detection.explained = 1.0;
  return detection;
}

// Standard deviation of a centre as the detector has it [px]: about the square root of its size.
inline double CenterSigma(const MarkerDetection& detection) {
  return 0.2 / std::sqrt(2.0 * detection.ellipse.semi_minor_px);
}

inline void AddNoise(double factor, Random* random, MarkerDetection* detection) {
  const double sigma = CenterSigma(*detection);
  detection->center_covariance_px2 = sigma * sigma * Eigen::Matrix2d::Identity();
  detection->center_px += random->Normal2(factor * sigma);
  Ellipse& ellipse = detection->ellipse;
  Eigen::Matrix2d shape = ellipse.PixelFromCircle();
  const double off = random->Normal(2.0 * factor * sigma);
  shape(0, 0) += random->Normal(2.0 * factor * sigma);
  shape(1, 1) += random->Normal(2.0 * factor * sigma);
  shape(0, 1) += off;
  shape(1, 0) += off;
  ellipse = EllipseOfAffine(detection->center_px, shape);
}

inline CalibrationPhoto SeePlates(const CalibrationSceneOptions& options,
                                  const std::vector<ScenePlate>& plates,
                                  const Rigid3& cam_from_plane,
                                  const std::string& name,
                                  Random* random) {
  CalibrationPhoto photo;
  photo.name = name;
  photo.width_px = options.camera.width_px();
  photo.height_px = options.camera.height_px();
  photo.is_lens_known = true;  // The centres are where they are seen.
  for (const ScenePlate& plate : plates) {
    const bool is_hidden = random->Uniform(0.0, 1.0) < options.hidden_share;
    auto detection = SeePlate(options.camera, cam_from_plane, plate);
    if (is_hidden || !detection) continue;
    AddNoise(options.noise_factor, random, &*detection);
    photo.markers.push_back(*detection);
  }
  return photo;
}

inline double ExtentOf(const std::vector<ScenePlate>& plates) {
  double extent = 0.0;
  for (const ScenePlate& plate : plates) {
    extent = std::max(extent, 2.0 * plate.center.head<2>().cwiseAbs().maxCoeff() + 1.25);
  }
  return extent;
}

inline std::vector<CalibrationPhoto> PhotographPlates(const CalibrationSceneOptions& options,
                                                      const std::vector<ScenePlate>& plates) {
  Random random(options.random_seed);
  std::vector<CalibrationPhoto> photos;
  for (int i = 0; i < options.num_photos; ++i) {
    const Rigid3 cam_from_plane = CalibrationPose(options, ExtentOf(plates), i, &random);
    photos.push_back(
        SeePlates(options, plates, cam_from_plane, std::to_string(i + 1) + ".jpg", &random));
  }
  return photos;
}

inline std::vector<CalibrationPhoto> MakeCalibrationPhotos(
    const CalibrationSceneOptions& options = {}) {
  Random random(1000 + options.random_seed);
  return PhotographPlates(options, StrewnPlates(&random));
}

}  // namespace plumb::test
