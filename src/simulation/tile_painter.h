// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "simulation/photo_job.h"
#include "simulation/sample_list.h"
#include "simulation/tile_tracer.h"

namespace plumb::internal {

// Paints the tiles of one photo. Not thread-safe: one instance a thread.
class TilePainter {
 public:
  explicit TilePainter(const PhotoJob& job) : job_(job), tracer_(job) {}

  // Of the tiles that cover the job's photo.
  static int NumTiles(const Camera& camera);

  // Writes tile `index` into `photo` (CV_32FC3: B, G, R).
  void Paint(int index, cv::Mat* photo);

 private:
  void Add(const std::vector<Sample>& samples, int samples_per_axis, float footprint_px);

  const PhotoJob& job_;
  TileTracer tracer_;
  SampleList samples_;
  std::array<cv::Vec3f, kTileRays> radiance_;
};

}  // namespace plumb::internal
