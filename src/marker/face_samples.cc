// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/face_samples.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

// How far out the face is laid over the photo: into the quiet zone, short of its edge.
constexpr double kFitRadius = 1.15;
constexpr double kMaxExaminedPixels = 20000.0;
constexpr std::size_t kMaxFitSamples = 4000;
constexpr double kEdgeReachPx = 2.5;
constexpr int kSparseStep = 3;

// Evenly.
std::vector<FaceSample> Thinned(const std::vector<FaceSample>& samples) {
  const std::size_t step = samples.size() / kMaxFitSamples + 1;
  std::vector<FaceSample> thinned;
  for (std::size_t i = 0; i < samples.size(); i += step) thinned.push_back(samples[i]);
  return thinned;
}

// Whether the face changes within reach of a pixel.
bool IsNearEdge(std::uint32_t word,
                const Eigen::Matrix3d& marker_from_pixel,
                const Eigen::Vector2d& pixel) {
  const auto is_white_at = [&](double x, double y) {
    const Eigen::Vector2d beside = pixel + kEdgeReachPx * Eigen::Vector2d(x, y);
    return IsWhite(word, (marker_from_pixel * beside.homogeneous()).hnormalized());
  };
  const bool is_white = is_white_at(-1.0, 0.0);
  return is_white != is_white_at(1.0, 0.0) || is_white != is_white_at(0.0, -1.0) ||
         is_white != is_white_at(0.0, 1.0);
}

}  // namespace

std::vector<FaceSample> SampleFace(const GraySampler& sampler,
                                   const LocalLens& lens,
                                   const MarkerDetection& detection,
                                   const Eigen::Matrix3d& pixel_from_marker) {
  const Eigen::Matrix3d marker_from_pixel = pixel_from_marker.inverse();
  const std::uint32_t word = MarkerCodebook::Get().Word(detection.id);
  const Ellipse& ellipse = detection.ellipse;
  const double reach_px = 1.3 * kFitRadius * ellipse.semi_major_px;
  const cv::Mat& gray = sampler.gray();
  const int x_begin = std::max(0, static_cast<int>(ellipse.center_px.x() - reach_px));
  const int y_begin = std::max(0, static_cast<int>(ellipse.center_px.y() - reach_px));
  const int x_end = std::min(gray.cols, static_cast<int>(ellipse.center_px.x() + reach_px) + 2);
  const int y_end = std::min(gray.rows, static_cast<int>(ellipse.center_px.y() + reach_px) + 2);
  const double area_px2 = M_PI * ellipse.semi_major_px * ellipse.semi_minor_px;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area_px2 / kMaxExaminedPixels)));
  std::vector<FaceSample> samples;
  for (int y = y_begin; y < y_end; y += stride) {
    const std::uint8_t* row = gray.ptr<std::uint8_t>(y);
    for (int x = x_begin; x < x_end; x += stride) {
      const Eigen::Vector2d pixel(x, y);
      const double radius = (marker_from_pixel * pixel.homogeneous()).hnormalized().norm();
      if (radius > kFitRadius || radius < kCrossRadius) continue;
      const bool is_sparse = x % kSparseStep == 0 && y % kSparseStep == 0;
      if (!is_sparse && !IsNearEdge(word, marker_from_pixel, pixel)) continue;
      const std::optional<Eigen::Vector2d> flat_px = lens.FlatFromRaw(pixel);
      if (!flat_px) continue;
      samples.push_back({*flat_px - lens.flat_origin_px(), static_cast<double>(row[x])});
    }
  }
  return Thinned(samples);
}

}  // namespace plumb
