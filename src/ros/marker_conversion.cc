// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/marker_conversion.h"

#include <Eigen/Dense>
#include <cmath>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb::ros_adapter {
namespace {

// Row by row.
template <typename Matrix, typename Array>
void ToArray(const Matrix& matrix, Array* array) {
  std::size_t i = 0;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index col = 0; col < matrix.cols(); ++col) (*array)[i++] = matrix(row, col);
  }
}

template <typename Matrix, typename Array>
Matrix FromArray(const Array& array) {
  Matrix matrix;
  std::size_t i = 0;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index col = 0; col < matrix.cols(); ++col) matrix(row, col) = array[i++];
  }
  return matrix;
}

bool IsShare(double value) { return value >= 0.0 && value <= 1.0; }

bool IsSound(const MarkerDetection& detection) {
  const Eigen::Matrix2d& covariance = detection.center_covariance_px2;
  const Ellipse& ellipse = detection.ellipse;
  return detection.center_px.allFinite() && covariance.allFinite() && covariance(0, 0) > 0.0 &&
         covariance.determinant() > 0.0 && ellipse.center_px.allFinite() &&
         std::isfinite(ellipse.semi_major_px) && ellipse.semi_minor_px > 0.0 &&
         ellipse.semi_major_px >= ellipse.semi_minor_px && std::isfinite(ellipse.angle_rad) &&
         detection.pixel_from_marker.allFinite() && IsShare(detection.probability) &&
         IsShare(detection.explained);
}

}  // namespace

plumbline::MarkerDetection ToMarkerDetectionMsg(const MarkerDetection& detection) {
  plumbline::MarkerDetection msg;
  msg.id = static_cast<std::uint32_t>(detection.id);
  ToArray(detection.center_px, &msg.center_px);
  ToArray(detection.center_covariance_px2, &msg.center_covariance_px2);
  ToArray(detection.ellipse.center_px, &msg.ellipse_center_px);
  msg.semi_major_px = detection.ellipse.semi_major_px;
  msg.semi_minor_px = detection.ellipse.semi_minor_px;
  msg.angle_rad = detection.ellipse.angle_rad;
  ToArray(detection.pixel_from_marker, &msg.pixel_from_marker);
  msg.probability = detection.probability;
  msg.explained = detection.explained;
  msg.num_corrected_bits = static_cast<std::uint32_t>(detection.num_corrected_bits);
  return msg;
}

std::optional<MarkerDetection> FromMarkerDetectionMsg(const plumbline::MarkerDetection& msg) {
  if (msg.id >= static_cast<std::uint32_t>(MarkerCodebook::Get().size())) return std::nullopt;
  if (msg.num_corrected_bits > static_cast<std::uint32_t>(kNumCodeBits)) return std::nullopt;
  MarkerDetection detection;
  detection.id = static_cast<int>(msg.id);
  detection.center_px = FromArray<Eigen::Vector2d>(msg.center_px);
  detection.center_covariance_px2 = FromArray<Eigen::Matrix2d>(msg.center_covariance_px2);
  detection.ellipse.center_px = FromArray<Eigen::Vector2d>(msg.ellipse_center_px);
  detection.ellipse.semi_major_px = msg.semi_major_px;
  detection.ellipse.semi_minor_px = msg.semi_minor_px;
  detection.ellipse.angle_rad = msg.angle_rad;
  detection.pixel_from_marker = FromArray<Eigen::Matrix3d>(msg.pixel_from_marker);
  detection.probability = msg.probability;
  detection.explained = msg.explained;
  detection.num_corrected_bits = static_cast<int>(msg.num_corrected_bits);
  if (!IsSound(detection)) return std::nullopt;
  return detection;
}

std::optional<std::vector<MarkerDetection>> FromMarkerDetectionsMsg(
    const plumbline::MarkerDetectionArray& msg) {
  std::vector<MarkerDetection> detections;
  for (const plumbline::MarkerDetection& detection_msg : msg.detections) {
    const std::optional<MarkerDetection> detection = FromMarkerDetectionMsg(detection_msg);
    if (!detection) return std::nullopt;
    detections.push_back(*detection);
  }
  return detections;
}

}  // namespace plumb::ros_adapter
