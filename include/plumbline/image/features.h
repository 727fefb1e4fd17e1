// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

using Rgb = std::array<std::uint8_t, 3>;

// A SIFT keypoint. Raw pixels of the full-resolution photo, whatever octave it
// came from; pixel (0, 0) is the top-left pixel's centre.
struct Feature {
  float x_px = 0.0F;
  float y_px = 0.0F;
  float scale_px = 0.0F;         // Gaussian sigma at which the feature was found.
  float orientation_rad = 0.0F;  // Of the dominant gradient, from x towards y.

  Eigen::Vector2d Pixel() const { return {x_px, y_px}; }
};

constexpr int kDescriptorSize = 128;

// One RootSIFT descriptor a row: round(512 sqrt(d / |d|_1)), at most 255
// (Arandjelovic & Zisserman, CVPR 2012); its Euclidean norm is about 512.
using DescriptorMatrix =
    Eigen::Matrix<std::uint8_t, Eigen::Dynamic, kDescriptorSize, Eigen::RowMajor>;

// The features of one photo, by decreasing scale; all three of equal length.
struct FeatureSet {
  std::vector<Feature> features;
  DescriptorMatrix descriptors;
  std::vector<Rgb> colors;

  std::size_t size() const { return features.size(); }
};

}  // namespace plumb
