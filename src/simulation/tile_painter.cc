// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/tile_painter.h"

#include <algorithm>

#include "simulation/sample_shader.h"

namespace plumb::internal {
namespace {

int TilesPerSide(int length_px) { return (length_px + kTileSide - 1) / kTileSide; }

}  // namespace

int TilePainter::NumTiles(const Camera& camera) {
  return TilesPerSide(camera.width_px()) * TilesPerSide(camera.height_px());
}

void TilePainter::Paint(int index, cv::Mat* photo) {
  const int columns = TilesPerSide(photo->cols);
  const int left = index % columns * kTileSide;
  const int top = index / columns * kTileSide;
  const int width = std::min(kTileSide, photo->cols - left);
  const int height = std::min(kTileSide, photo->rows - top);
  tracer_.Trace(left, top, width, height);
  radiance_.fill(cv::Vec3f());
  Add(tracer_.whole_pixels(), job_.samples_per_axis, 1.0F);
  Add(tracer_.parts_of_pixels(), 1, 1.0F / static_cast<float>(job_.samples_per_axis));
  for (int row = 0; row < height; ++row) {
    const cv::Vec3f* first = &radiance_[(row + 1) * kTileStride + 1];
    std::copy(first, first + width, photo->ptr<cv::Vec3f>(top + row) + left);
  }
}

// Each sample has a square of `footprint_px` of its pixel, and so that share of its area.
void TilePainter::Add(const std::vector<Sample>& samples,
                      int samples_per_axis,
                      float footprint_px) {
  samples_.Assign(samples);
  ShadeSamples(job_, samples_per_axis, footprint_px, &samples_);
  const float share = footprint_px * footprint_px;
  for (const SampleGroup& group : samples_.groups()) {
    const ColorList color = samples_.Radiance(group);
    for (int i = 0; i < group.count; ++i) {
      radiance_[samples_.pixel(group.begin + i)] +=
          share * cv::Vec3f(color.blue[i], color.green[i], color.red[i]);
    }
  }
}

}  // namespace plumb::internal
