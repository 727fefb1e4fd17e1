// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb::test {

// Whether a point of a printed face is white; in outer radii (half sides), y down.
using Face = std::function<bool(const Eigen::Vector2d&)>;

inline Face MarkerFace(int id) {
  const std::uint32_t word = MarkerCodebook::Get().Word(id);
  return [word](const Eigen::Vector2d& point) { return IsWhite(word, point); };
}

// A square plate with a face; the face's radius is 1 and so depth and focal length give the size.
struct PlacedFace {
  Face face;
  Rigid3 cam_from_marker;
  double half_side = kQuietRadius;
};

struct PhotoConditions {
  double black = 40.0;
  double white = 200.0;
  double background = 110.0;
  double blur_px = 0.8;      // Sigma, besides the pixel's own area.
  double noise = 2.0;        // Sigma [grey levels].
  int samples_per_axis = 8;  // Of each pixel.
  std::uint32_t seed = 1;    // Of the noise.
};

// Derivative of raw pixels by the plane of a marker, at its centre.
inline Eigen::Matrix2d PixelByMarker(const Camera& camera, const Rigid3& cam_from_marker) {
  constexpr double kStep = 1e-4;
  Eigen::Matrix2d derivative;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    derivative.col(i) =
        (*camera.Project(cam_from_marker * step) - *camera.Project(cam_from_marker * -step)) /
        (2.0 * kStep);
  }
  return derivative;
}

// Camera from a marker of radius 1 that is seen at `pixel` with a diameter (along its major axis,
// to first order) of `diameter_px`, tilted about an axis at `axis_rad` in the image, and turned.
inline Rigid3 PlaceMarker(const Camera& camera,
                          const Eigen::Vector2d& pixel,
                          double diameter_px,
                          double tilt_rad,
                          double axis_rad,
                          double turn_rad) {
  const Eigen::Vector3d ray = camera.Unproject(pixel)->homogeneous();
  const Eigen::Vector3d axis(std::cos(axis_rad), std::sin(axis_rad), 0.0);
  const Eigen::Quaterniond towards =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray);
  const Eigen::Quaterniond rotation = towards * Eigen::AngleAxisd(tilt_rad, axis) *
                                      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
  const double depth = camera.MeanFocalLength() * 2.0 / diameter_px;
  // Size falls with depth; a wide lens shows it larger towards the photo's corners.
  const Eigen::JacobiSVD<Eigen::Matrix2d> axes(
      PixelByMarker(camera, Rigid3{rotation, depth * ray}));
  const double seen_px = 2.0 * axes.singularValues()(0);
  return Rigid3{rotation, depth * seen_px / diameter_px * ray};
}

// Draws one plate into a float image: every pixel the mean over its area.
inline void DrawFace(const Camera& camera,
                     const PlacedFace& placed,
                     const PhotoConditions& conditions,
                     cv::Mat* image) {
  const Eigen::Matrix3d rotation = placed.cam_from_marker.rotation.toRotationMatrix();
  Eigen::Matrix3d cam_from_plane;
  cam_from_plane << rotation.leftCols<2>(), placed.cam_from_marker.translation;
  const Eigen::Matrix3d plane_from_cam = cam_from_plane.inverse();
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 16; ++i) {
    const double at = -1.0 + (i % 4) / 2.0;  // Along each side: -1, -0.5, 0, 0.5.
    const double sides[4][2] = {{at, -1.0}, {1.0, at}, {-at, 1.0}, {-1.0, -at}};
    const Eigen::Vector3d corner(
        placed.half_side * sides[i / 4][0], placed.half_side * sides[i / 4][1], 1.0);
    if (const auto pixel = camera.Project(cam_from_plane * corner)) box.extend(*pixel);
  }
  const int count = conditions.samples_per_axis;
  const int x_end = std::min(image->cols - 1, static_cast<int>(box.max().x()) + 2);
  const int y_end = std::min(image->rows - 1, static_cast<int>(box.max().y()) + 2);
  for (int y = std::max(0, static_cast<int>(box.min().y()) - 1); y <= y_end; ++y) {
    for (int x = std::max(0, static_cast<int>(box.min().x()) - 1); x <= x_end; ++x) {
      double sum = 0.0;
      double num_inside = 0.0;
      // Within a pixel the ray is linear.
      const Eigen::Vector2d middle = *camera.Unproject({x, y});
      const Eigen::Vector2d across = *camera.Unproject({x + 1, y}) - middle;
      const Eigen::Vector2d down = *camera.Unproject({x, y + 1}) - middle;
      for (int i = 0; i < count * count; ++i) {
        const double right = (i % count + 0.5) / count - 0.5;
        const double below = (i / count + 0.5) / count - 0.5;
        const Eigen::Vector2d ray = middle + right * across + below * down;
        const Eigen::Vector2d point = (plane_from_cam * ray.homogeneous()).hnormalized();
        if (point.cwiseAbs().maxCoeff() > placed.half_side) continue;
        num_inside += 1.0;
        sum += placed.face(point) ? conditions.white : conditions.black;
      }
      float& pixel = image->at<float>(y, x);
      const double share = num_inside / (count * count);
      pixel = static_cast<float>(sum / (count * count) + (1.0 - share) * pixel);
    }
  }
}

// Blur, noise and rounding to 8 bits.
inline cv::Mat Expose(const cv::Mat& irradiance, const PhotoConditions& conditions) {
  cv::Mat blurred = irradiance.clone();
  if (conditions.blur_px > 0.0) {
    cv::GaussianBlur(blurred, blurred, {0, 0}, conditions.blur_px, 0.0, cv::BORDER_REPLICATE);
  }
  if (conditions.noise > 0.0) {
    cv::Mat noise(blurred.size(), CV_32F);
    cv::RNG random(conditions.seed);
    random.fill(noise, cv::RNG::NORMAL, 0.0, conditions.noise);
    blurred += noise;
  }
  cv::Mat gray;
  blurred.convertTo(gray, CV_8U);
  return gray;
}

inline cv::Mat RenderPhoto(const Camera& camera,
                           const std::vector<PlacedFace>& faces,
                           const PhotoConditions& conditions) {
  cv::Mat image(camera.height_px(), camera.width_px(), CV_32F, cv::Scalar(conditions.background));
  for (const PlacedFace& face : faces) DrawFace(camera, face, conditions, &image);
  return Expose(image, conditions);
}

}  // namespace plumb::test
