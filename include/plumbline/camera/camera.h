// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "plumbline/camera/projection.h"

namespace plumb {

// ROS names: "plumb_bob" (5 coefficients) and "rational_polynomial" (8).
enum class DistortionModel { kPlumbBob, kRationalPolynomial };

// The lens and sensor that all photos of a session share. Pixels are raw
// (distorted); pixel (0, 0) is the top-left pixel's centre. Thread-safe: immutable
// but for assignment.
class Camera {
 public:
  // Throws std::invalid_argument naming the field and its value if a size or a
  // focal length is not positive, a value is not finite, the principal point
  // lies outside the image, or the distortion folds the image (is not
  // one-to-one within it).
  Camera(std::string name,
         int width_px,
         int height_px,
         DistortionModel model,
         const LensParameters<double>& lens);

  // The same with another lens, such as a bundle's; nothing if no camera can have it.
  std::optional<Camera> WithLens(const LensParameters<double>& lens) const;

  const std::string& name() const { return name_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  DistortionModel model() const { return model_; }
  const LensParameters<double>& lens() const { return lens_; }

  // sqrt(fx fy) [px].
  double MeanFocalLength() const;

  // Raw pixel of a point in the camera frame; nothing if the point is not in
  // front of the camera or lies beyond the field where the distortion is one-to-one.
  // The pixel may lie outside the image.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_cam) const;

  // Normalised coordinates (x, y) of the viewing ray (x, y, 1) of a raw pixel, by Newton's
  // method to 1e-6 px or better; nothing if the pixel is not in the lens's field.
  std::optional<Eigen::Vector2d> Unproject(const Eigen::Vector2d& pixel) const;

  bool IsInImage(const Eigen::Vector2d& pixel) const;

 private:
  std::string name_;
  int width_px_;
  int height_px_;
  DistortionModel model_;
  LensParameters<double> lens_;
  double max_radius2_;  // Largest squared normalised radius of the one-to-one field.
};

// Reads ROS camera_info YAML (as camera_calibration writes it). Throws
// std::runtime_error naming the file, the field and what is wrong with it.
Camera ReadCameraYaml(const std::string& path);

// The same from text; `source` names it in errors.
Camera ParseCameraYaml(const std::string& text, const std::string& source);

// ROS camera_info YAML of `camera`; ParseCameraYaml reads it back exactly.
std::string ToCameraYaml(const Camera& camera);

}  // namespace plumb
