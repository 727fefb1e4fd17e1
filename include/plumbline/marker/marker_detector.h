// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/marker/ellipse.h"
#include "plumbline/marker/marker_detector_options.h"

namespace plumb {

// A coded marker in a photo. Raw (distorted) pixels; pixel (0, 0) is the top-left pixel's centre.
struct MarkerDetection {
  int id = -1;
  // Where the marker's centre is seen, corrected for perspective; not the ellipse's centre.
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d center_covariance_px2 = Eigen::Matrix2d::Zero();
  Ellipse ellipse;  // The outer circle as seen.
  // Homography from the marker's frame (marker_layout.h), scaled so that its last entry is 1.
  // With a camera, to the pixels of a pinhole camera with the same fx, fy, cx, cy.
  Eigen::Matrix3d pixel_from_marker = Eigen::Matrix3d::Identity();
  double probability = 0.0;    // Of the code against all others.
  double explained = 0.0;      // Share of the grey values' variance that the face explains.
  int num_corrected_bits = 0;  // Cells that by themselves would have been read otherwise.
};

// Finds the coded markers of a grey photo (CV_8UC1): local threshold, contours, ellipses, circles,
// unrolled code, and last the marker's face laid over the photo by least squares. By ID, then
// by place; the same marker may be there twice. With a camera, whose size must be the photo's,
// its distortion is undone before the face is laid over. Deterministic; thread-safe.
//
// Throws std::invalid_argument if options.Problems() is not empty, or the photo is not CV_8UC1
// or not of the camera's size.
std::vector<MarkerDetection> DetectMarkers(const MarkerDetectorOptions& options,
                                           const cv::Mat& gray,
                                           const Camera* camera = nullptr);

}  // namespace plumb
