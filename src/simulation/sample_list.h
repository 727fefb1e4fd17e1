// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "simulation/shade_job.h"
#include "simulation/tile_lens.h"

namespace plumb::internal {

// One viewing ray, the patch that it meets, and how much of the sun is seen there.
struct Sample {
  int pixel;  // Of the tile.
  int patch;  // kSkyPatch: none.
  PixelRay ray;
  float sun;
};

constexpr int kSkyPatch = -1;

// Consecutive samples of one patch.
struct SampleGroup {
  int patch;
  int begin;  // A multiple of kListAlignment.
  int count;
};

// Samples ordered by patch, by component, as the shading kernels want them. Each group is padded
// with copies of its last sample.
class SampleList {
 public:
  void Assign(const std::vector<Sample>& samples);

  const std::vector<SampleGroup>& groups() const { return groups_; }
  int pixel(int index) const { return pixels_[index]; }

  // Of one group.
  RayList Rays(const SampleGroup& group) const;
  TextureList Texture(const SampleGroup& group);
  LightList Light(const SampleGroup& group) const;
  ColorList Radiance(const SampleGroup& group);

  // By sample, to be written.
  float* ambient() { return Column(kAmbient); }
  float* run_off() { return Column(kRunOff); }

 private:
  enum ColumnIndex {
    kX,
    kY,
    kXByColumn,
    kXByRow,
    kYByColumn,
    kYByRow,
    kSun,
    kAmbient,
    kRunOff,
    kU,
    kV,
    kUByColumn,
    kUByRow,
    kVByColumn,
    kVByRow,
    kRed,
    kGreen,
    kBlue,
    kNumColumns
  };

  int GroupOf(int patch);
  void Put(int index, const Sample& sample);
  float* Column(ColumnIndex column) { return values_.data() + column * size_; }
  const float* Column(ColumnIndex column) const { return values_.data() + column * size_; }

  std::vector<SampleGroup> groups_;
  std::vector<int> group_of_sample_;
  std::vector<int> pixels_;
  std::vector<float> values_;  // Column by column.
  std::size_t size_ = 0;       // Of a column.
};

}  // namespace plumb::internal
