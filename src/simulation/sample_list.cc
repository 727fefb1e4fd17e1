// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/sample_list.h"

#include <algorithm>

namespace plumb::internal {
namespace {

int Padded(int count) { return (count + kListAlignment - 1) / kListAlignment * kListAlignment; }

}  // namespace

int SampleList::GroupOf(int patch) {
  for (int i = static_cast<int>(groups_.size()) - 1; i >= 0; --i) {
    if (groups_[i].patch == patch) return i;
  }
  groups_.push_back({patch, 0, 0});
  return static_cast<int>(groups_.size()) - 1;
}

void SampleList::Assign(const std::vector<Sample>& samples) {
  groups_.clear();
  group_of_sample_.resize(samples.size());
  int group = -1;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // Neighbours mostly lie on one patch.
    if (group < 0 || groups_[group].patch != samples[i].patch) group = GroupOf(samples[i].patch);
    group_of_sample_[i] = group;
    ++groups_[group].count;
  }
  int end = 0;
  std::vector<int> next;
  for (SampleGroup& entry : groups_) {
    entry.begin = end;
    next.push_back(end);
    end += Padded(entry.count);
  }
  size_ = static_cast<std::size_t>(end);
  pixels_.resize(size_);
  values_.resize(kNumColumns * size_);
  for (std::size_t i = 0; i < samples.size(); ++i) Put(next[group_of_sample_[i]]++, samples[i]);
  for (const SampleGroup& entry : groups_) {
    for (int column = 0; column <= kSun; ++column) {
      float* values = Column(static_cast<ColumnIndex>(column)) + entry.begin;
      std::fill(values + entry.count, values + Padded(entry.count), values[entry.count - 1]);
    }
  }
}

void SampleList::Put(int index, const Sample& sample) {
  pixels_[index] = sample.pixel;
  Column(kX)[index] = sample.ray.x;
  Column(kY)[index] = sample.ray.y;
  Column(kXByColumn)[index] = sample.ray.x_by_column;
  Column(kXByRow)[index] = sample.ray.x_by_row;
  Column(kYByColumn)[index] = sample.ray.y_by_column;
  Column(kYByRow)[index] = sample.ray.y_by_row;
  Column(kSun)[index] = sample.sun;
}

RayList SampleList::Rays(const SampleGroup& group) const {
  const auto at = [&](ColumnIndex column) { return Column(column) + group.begin; };
  return {Padded(group.count),
          at(kX),
          at(kY),
          at(kXByColumn),
          at(kXByRow),
          at(kYByColumn),
          at(kYByRow)};
}

TextureList SampleList::Texture(const SampleGroup& group) {
  const auto at = [&](ColumnIndex column) { return Column(column) + group.begin; };
  return {at(kU), at(kV), at(kUByColumn), at(kUByRow), at(kVByColumn), at(kVByRow)};
}

LightList SampleList::Light(const SampleGroup& group) const {
  return {
      Column(kSun) + group.begin, Column(kAmbient) + group.begin, Column(kRunOff) + group.begin};
}

ColorList SampleList::Radiance(const SampleGroup& group) {
  return {Column(kRed) + group.begin, Column(kGreen) + group.begin, Column(kBlue) + group.begin};
}

}  // namespace plumb::internal
