// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/scale_space.h"

#include <cmath>
#include <utility>

#include "image/gaussian_blur.h"

namespace plumb {

double LevelSigma(double level) { return kBaseSigma * std::exp2(level / kScalesPerOctave); }

Octave BuildOctave(FloatImage base, double full_px_per_px, double full_px_offset, int num_threads) {
  Octave octave;
  octave.full_px_per_px = full_px_per_px;
  octave.full_px_offset = full_px_offset;
  octave.levels[0] = std::move(base);
  for (int level = 1; level < kLevelsPerOctave; ++level) {
    // Variances add: blurs the level before by what is missing.
    const double sigma =
        std::sqrt(std::pow(LevelSigma(level), 2) - std::pow(LevelSigma(level - 1), 2));
    octave.levels[level] = BlurGaussian(octave.levels[level - 1], sigma, num_threads);
  }
  return octave;
}

Octave BuildNextOctave(const Octave& finer, int num_threads) {
  const FloatImage& source = finer.levels[kScalesPerOctave];  // Of twice the base sigma.
  FloatImage base((source.width() + 1) / 2, (source.height() + 1) / 2);
  for (int y = 0; y < base.height(); ++y) {
    const float* from = source.Row(2 * y);
    float* to = base.Row(y);
    for (int x = 0; x < base.width(); ++x) to[x] = from[2 * x];
    base.FillPadding(y);
  }
  return BuildOctave(
      std::move(base), 2.0 * finer.full_px_per_px, finer.full_px_offset, num_threads);
}

FloatImage BlurToBase(const FloatImage& image, double image_sigma_px, int num_threads) {
  const double sigma = std::sqrt(kBaseSigma * kBaseSigma - image_sigma_px * image_sigma_px);
  return BlurGaussian(image, sigma, num_threads);
}

}  // namespace plumb
