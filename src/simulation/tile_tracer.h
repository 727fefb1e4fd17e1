// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "simulation/photo_job.h"
#include "simulation/sample_list.h"

namespace plumb::internal {

// A photo is rendered tile by tile. With a border of one pixel, to see where patches and shadows
// end, a tile has 64 x 64 rays in packets of 4 x 4.
constexpr int kTileSide = 62;
constexpr int kTileStride = kTileSide + 2;
constexpr int kTileRays = kTileStride * kTileStride;

// Casts the rays of tiles: one a pixel, and one for each place of a pixel's area where a
// patch or a shadow ends in it or beside it. Not thread-safe: one instance a thread.
class TileTracer {
 public:
  explicit TileTracer(const PhotoJob& job);

  // The tile with the upper left pixel (left, top); pixel i of a sample is at row i / kTileStride
  // - 1, column i % kTileStride - 1 of it. Replaces whole_pixels(), parts_of_pixels().
  void Trace(int left, int top, int width, int height);

  // Each sample stands for the whole pixel, seen along its centre.
  const std::vector<Sample>& whole_pixels() const { return whole_pixels_; }
  // Each stands for one of samples_per_axis^2 equal parts of its pixel.
  const std::vector<Sample>& parts_of_pixels() const { return parts_; }

 private:
  void CastPixels();
  void CastShadows();
  void Collect();
  bool IsEdge(int pixel) const;
  bool IsShadowEdge(int pixel) const;
  PixelRay PartOf(int pixel, int part) const;
  float SunShare(int pixel) const;
  void CastParts();

  Eigen::Vector3f DirectionOf(const PixelRay& ray) const;
  void SetRay(int slot, const PixelRay& ray, RayPacket* packet) const;
  void SetShadowRay(int slot, int patch, const PixelRay& ray, RayPacket* packet) const;

  const PhotoJob& job_;
  const Eigen::Vector3f center_;
  const Eigen::Matrix3f world_from_cam_;
  const Eigen::Vector3f towards_sun_;

  int width_ = 0, height_ = 0;
  std::array<PixelRay, kTileRays> rays_;
  std::array<int, kTileRays> patch_;
  std::array<bool, kTileRays> is_lit_;
  std::vector<Sample> whole_pixels_, parts_;
};

}  // namespace plumb::internal
