// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "image/extrema.h"
#include "image/photo_raster.h"
#include "image/scale_space.h"
#include "plumbline/image/feature_options.h"
#include "plumbline/image/features.h"

namespace plumb {

// Finds the largest SIFT features of one photo. Starts at a resolution expected to hold
// enough of them and adds a finer octave only where it did not. Not thread-safe.
class FeatureExtractor {
 public:
  // `raster` must outlive the extractor.
  FeatureExtractor(const FeatureOptions& options, const PhotoRaster& raster, PhotoSize size);

  // Decodes the first resolution and searches it and all coarser ones.
  void SearchCoarse();

  // Decodes and searches finer ones until there are enough features or the options' end.
  void SearchFiner();

  // Selects, orients and describes.
  FeatureSet Describe() const;

  // The finest octave of SearchCoarse.
  const Octave& first_octave() const { return octaves_.front(); }
  double decode_s() const { return decode_s_; }

 private:
  Octave DecodeOctave(int eighths);
  void KeepExtrema(std::vector<Extremum> found);

  const FeatureOptions& options_;
  const PhotoRaster& raster_;
  PhotoSize size_;
  int eighths_;  // Of the finest octave.
  std::vector<Octave> octaves_;
  std::vector<Extremum> extrema_;
  double decode_s_ = 0.0;
};

}  // namespace plumb
