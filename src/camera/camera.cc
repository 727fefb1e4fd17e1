// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/camera/camera.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "camera/lens_field.h"

namespace plumb {
namespace {

constexpr std::array<const char*, kNumLensParameters> kLensParameterNames = {
    "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};

// Far below the 1e-6 px promised and far above rounding, some 1e-12 px.
constexpr double kUnprojectTolerancePx = 1e-9;
constexpr int kMaxUnprojectIterations = 60;

template <typename Value>
[[noreturn]] void Refuse(const char* field, const char* bound, const Value& value) {
  std::ostringstream message;
  message << field << " must be " << bound << ", but is " << value;
  throw std::invalid_argument(message.str());
}

void CheckSizeAndLens(int width_px,
                      int height_px,
                      DistortionModel model,
                      const LensParameters<double>& lens) {
  if (width_px <= 0) Refuse("image_width", "positive", width_px);
  if (height_px <= 0) Refuse("image_height", "positive", height_px);
  for (int i = 0; i < kNumLensParameters; ++i) {
    if (!std::isfinite(lens[i])) Refuse(kLensParameterNames[i], "a finite number", lens[i]);
  }
  if (lens[kFx] <= 0.0) Refuse("focal length fx", "positive", lens[kFx]);
  if (lens[kFy] <= 0.0) Refuse("focal length fy", "positive", lens[kFy]);
  if (lens[kCx] < -0.5 || lens[kCx] > width_px - 0.5) {
    Refuse("principal point cx", "inside the image", lens[kCx]);
  }
  if (lens[kCy] < -0.5 || lens[kCy] > height_px - 0.5) {
    Refuse("principal point cy", "inside the image", lens[kCy]);
  }
  if (model == DistortionModel::kPlumbBob) {
    for (const int i : {kK4, kK5, kK6}) {
      if (lens[i] != 0.0) Refuse(kLensParameterNames[i], "0 for plumb_bob", lens[i]);
    }
  }
}

// The image's border must be in the lens's field; its inside then is too, as the
// field's image is simply connected.
void CheckFieldCoversImage(const Camera& camera) {
  constexpr int kStepsPerSide = 32;
  const double right = camera.width_px() - 0.5;
  const double bottom = camera.height_px() - 0.5;
  for (int i = 0; i <= kStepsPerSide; ++i) {
    const double x = -0.5 + i * (right + 0.5) / kStepsPerSide;
    const double y = -0.5 + i * (bottom + 0.5) / kStepsPerSide;
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(x, -0.5),
                                         Eigen::Vector2d(x, bottom),
                                         Eigen::Vector2d(-0.5, y),
                                         Eigen::Vector2d(right, y)}) {
      if (camera.Unproject(pixel)) continue;
      std::ostringstream message;
      message
          << "distortion coefficients must be one-to-one within the image, but fold it at pixel ("
          << pixel.x() << ", " << pixel.y() << ")";
      throw std::invalid_argument(message.str());
    }
  }
}

}  // namespace

Camera::Camera(std::string name,
               int width_px,
               int height_px,
               DistortionModel model,
               const LensParameters<double>& lens)
    : name_(std::move(name)),
      width_px_(width_px),
      height_px_(height_px),
      model_(model),
      lens_(lens) {
  CheckSizeAndLens(width_px, height_px, model, lens);
  const double max_radius = OneToOneRadius(lens_);
  max_radius2_ = max_radius * max_radius;
  CheckFieldCoversImage(*this);
}

std::optional<Camera> Camera::WithLens(const LensParameters<double>& lens) const {
  try {
    return Camera(name_, width_px_, height_px_, model_, lens);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

double Camera::MeanFocalLength() const { return std::sqrt(lens_[kFx] * lens_[kFy]); }

std::optional<Eigen::Vector2d> Camera::Project(const Eigen::Vector3d& point_in_cam) const {
  if (!(point_in_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d xy = point_in_cam.hnormalized();
  if (!(xy.squaredNorm() <= max_radius2_)) return std::nullopt;
  Eigen::Vector2d pixel;
  ProjectToPixel(lens_.data(), point_in_cam.data(), pixel.data());
  return pixel;
}

std::optional<Eigen::Vector2d> Camera::Unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d distorted((pixel.x() - lens_[kCx]) / lens_[kFx],
                                  (pixel.y() - lens_[kCy]) / lens_[kFy]);
  const double tolerance = kUnprojectTolerancePx / std::max(lens_[kFx], lens_[kFy]);
  Eigen::Vector2d xy = distorted;
  const double radius2 = xy.squaredNorm();
  if (!std::isfinite(radius2)) return std::nullopt;
  if (radius2 >= max_radius2_) xy *= 0.9 * std::sqrt(max_radius2_ / radius2);

  // Newton's method with step halving. Within the field the Jacobian is positive
  // definite, so each Newton step is a descent direction of the error's norm.
  DistortedPoint current = DistortWithJacobian(lens_, xy);
  double error = (distorted - current.xy).norm();
  for (int i = 0; i < kMaxUnprojectIterations && error > tolerance; ++i) {
    Eigen::Vector2d step = current.jacobian.inverse() * (distorted - current.xy);
    bool improved = false;
    for (int halving = 0; halving < 40 && !improved; ++halving, step *= 0.5) {
      const Eigen::Vector2d next_xy = xy + step;
      if (!(next_xy.squaredNorm() <= max_radius2_)) continue;
      const DistortedPoint next = DistortWithJacobian(lens_, next_xy);
      const double next_error = (distorted - next.xy).norm();
      if (!(next_error < error)) continue;
      improved = true;
      xy = next_xy;
      current = next;
      error = next_error;
    }
    if (!improved) break;
  }
  if (error > tolerance) return std::nullopt;
  return xy;
}

bool Camera::IsInImage(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width_px_ - 0.5 &&
         pixel.y() < height_px_ - 0.5;
}

}  // namespace plumb
