// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "image/float_image.h"

namespace plumb {

constexpr int kScalesPerOctave = 3;                     // Lowe, IJCV 2004, section 3.2.
constexpr int kLevelsPerOctave = kScalesPerOctave + 3;  // Gaussians.
constexpr double kBaseSigma = 1.6;                      // Of level 0, in pixels of the octave.

// Gaussian images of one resolution; level l has sigma kBaseSigma 2^(l / kScalesPerOctave).
struct Octave {
  // Pixel x of the octave is at full-resolution pixel x full_px_per_px + full_px_offset.
  double full_px_per_px = 1.0;
  double full_px_offset = 0.0;
  std::array<FloatImage, kLevelsPerOctave> levels;

  int width() const { return levels[0].width(); }
  int height() const { return levels[0].height(); }
};

// Sigma of a (fractional) level, in pixels of its octave.
double LevelSigma(double level);

// Builds an octave from an image already blurred to kBaseSigma.
Octave BuildOctave(FloatImage base, double full_px_per_px, double full_px_offset, int num_threads);

// The octave of half the resolution; nothing more is blurred than needed.
Octave BuildNextOctave(const Octave& finer, int num_threads);

// Blurs a decoded image from `image_sigma_px`, the blur that decoding leaves, to kBaseSigma.
FloatImage BlurToBase(const FloatImage& image, double image_sigma_px, int num_threads);

}  // namespace plumb
