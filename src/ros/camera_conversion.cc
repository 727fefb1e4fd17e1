// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/camera_conversion.h"

#include <sensor_msgs/distortion_models.h>

#include <stdexcept>

namespace plumb::ros_adapter {
namespace {

// Order of sensor_msgs/CameraInfo.D.
constexpr int kDistortionOrder[] = {kK1, kK2, kP1, kP2, kK3, kK4, kK5, kK6};

std::size_t NumCoefficients(DistortionModel model) {
  return model == DistortionModel::kPlumbBob ? 5 : 8;
}

DistortionModel ModelFromName(const std::string& name) {
  if (name == sensor_msgs::distortion_models::PLUMB_BOB) return DistortionModel::kPlumbBob;
  if (name == sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL) {
    return DistortionModel::kRationalPolynomial;
  }
  throw std::invalid_argument(
      "camera_info: distortion_model must be plumb_bob or "
      "rational_polynomial, but is \"" +
      name + '"');
}

void RefuseWhatIsNotUsed(const sensor_msgs::CameraInfo& msg) {
  if (msg.K[1] != 0.0) throw std::invalid_argument("camera_info: K has a skew, which is not used");
  if (msg.binning_x > 1 || msg.binning_y > 1) {
    throw std::invalid_argument("camera_info: binning is not used; give the photos' own size");
  }
  if (msg.roi.width != 0 || msg.roi.height != 0 || msg.roi.x_offset != 0 || msg.roi.y_offset != 0) {
    throw std::invalid_argument("camera_info: a roi is not used; give the photos' own size");
  }
}

}  // namespace

sensor_msgs::CameraInfo ToCameraInfoMsg(const Camera& camera) {
  const LensParameters<double>& lens = camera.lens();
  sensor_msgs::CameraInfo msg;
  msg.width = static_cast<std::uint32_t>(camera.width_px());
  msg.height = static_cast<std::uint32_t>(camera.height_px());
  msg.distortion_model = camera.model() == DistortionModel::kPlumbBob
                             ? sensor_msgs::distortion_models::PLUMB_BOB
                             : sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL;
  for (std::size_t i = 0; i < NumCoefficients(camera.model()); ++i) {
    msg.D.push_back(lens[static_cast<std::size_t>(kDistortionOrder[i])]);
  }
  msg.K = {lens[kFx], 0.0, lens[kCx], 0.0, lens[kFy], lens[kCy], 0.0, 0.0, 1.0};
  msg.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  msg.P = {lens[kFx], 0.0, lens[kCx], 0.0, 0.0, lens[kFy], lens[kCy], 0.0, 0.0, 0.0, 1.0, 0.0};
  return msg;
}

Camera FromCameraInfoMsg(const sensor_msgs::CameraInfo& msg, const std::string& name) {
  const DistortionModel model = ModelFromName(msg.distortion_model);
  RefuseWhatIsNotUsed(msg);
  if (msg.D.size() != NumCoefficients(model)) {
    throw std::invalid_argument("camera_info: D must have " +
                                std::to_string(NumCoefficients(model)) + " values for " +
                                msg.distortion_model + ", but has " + std::to_string(msg.D.size()));
  }
  LensParameters<double> lens{};
  lens[kFx] = msg.K[0];
  lens[kCx] = msg.K[2];
  lens[kFy] = msg.K[4];
  lens[kCy] = msg.K[5];
  for (std::size_t i = 0; i < msg.D.size(); ++i) {
    lens[static_cast<std::size_t>(kDistortionOrder[i])] = msg.D[i];
  }
  return Camera(name, static_cast<int>(msg.width), static_cast<int>(msg.height), model, lens);
}

bool IsSameCamera(const Camera& a, const Camera& b) {
  return a.width_px() == b.width_px() && a.height_px() == b.height_px() && a.model() == b.model() &&
         a.lens() == b.lens();
}

}  // namespace plumb::ros_adapter
