// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "test/support/calibration_scene.h"
#include "test/support/marker_scene.h"

namespace plumb::test {

// A small camera with the lens of CalibrationLens: photos of it are rendered in tenths of a second.
inline Camera SmallCalibrationCamera() {
  LensParameters<double> lens = CalibrationLens();
  constexpr int kWidth_px = 960;
  const double scale = kWidth_px / 2000.0;
  lens[kFx] *= scale;
  lens[kFy] *= scale;
  lens[kCx] *= scale;
  lens[kCy] *= scale;
  return CalibrationCamera(lens, kWidth_px, 640);
}

// Camera from a plate's own frame: radius 1, x right and y down as printed.
inline Rigid3 CamFromPlate(const Rigid3& cam_from_plane, const ScenePlate& plate) {
  const double c = std::cos(plate.angle_rad);
  const double s = std::sin(plate.angle_rad);
  Eigen::Matrix3d plane_from_plate;
  plane_from_plate << c, s, 0.0, s, -c, 0.0, 0.0, 0.0, -1.0;
  return {cam_from_plane.rotation * Eigen::Quaterniond(plane_from_plate),
          2.0 * (cam_from_plane * plate.center)};
}

// The photos of a round about strewn markers, of the options' camera.
inline std::vector<cv::Mat> RenderCalibrationPhotos(const CalibrationSceneOptions& options) {
  Random plate_random(1000 + options.random_seed);
  const std::vector<ScenePlate> plates = StrewnPlates(&plate_random);
  Random random(options.random_seed);
  PhotoConditions conditions;
  conditions.samples_per_axis = 4;
  std::vector<cv::Mat> photos;
  for (int i = 0; i < options.num_photos; ++i) {
    const Rigid3 cam_from_plane = CalibrationPose(options, ExtentOf(plates), i, &random);
    std::vector<PlacedFace> faces;
    for (const ScenePlate& plate : plates) {
      faces.push_back({MarkerFace(plate.id), CamFromPlate(cam_from_plane, plate)});
    }
    conditions.seed = static_cast<std::uint32_t>(i + 1);
    photos.push_back(RenderPhoto(options.camera, faces, conditions));
  }
  return photos;
}

}  // namespace plumb::test
