// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/blur_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumb {
namespace {

constexpr int kDirections = 4;  // Of 45 degrees each.
constexpr int kStep = 4;        // Every fourth row holds edges enough.
constexpr int kMargin = 12;     // Keeps off the border, where blurring repeats the last pixel.
constexpr std::size_t kMinEdges = 50;  // Of a direction, to judge it.
// Of grey values two pixels apart: 4, which noise does not reach after blurring.
constexpr float kMinSquaredGradient = 16.0F;
constexpr double kMaxBlur = 100.0;  // Pixels of the octave; beyond, no ratio can be told from 1.
constexpr int kFineLevel = 0;
constexpr int kCoarseLevel = kScalesPerOctave;  // Twice the sigma.

struct Gradient {
  float x;
  float y;
  float SquaredNorm() const { return x * x + y * y; }
};

Gradient GradientAt(const FloatImage& image, int x, int y) {
  return {image.At(x + 1, y) - image.At(x - 1, y), image.At(x, y + 1) - image.At(x, y - 1)};
}

struct Edge {
  float squared_strength;
  float squared_ratio;  // Of the strengths at the fine and the coarse level.
};

// 0: along x, then by 45 degrees towards y.
int DirectionOf(const Gradient& gradient) {
  const float tan_22_5_deg = 0.41421356F;
  const float size_x = std::abs(gradient.x);
  const float size_y = std::abs(gradient.y);
  if (size_y <= tan_22_5_deg * size_x) return 0;
  if (size_x <= tan_22_5_deg * size_y) return 2;
  return (gradient.x > 0.0F) == (gradient.y > 0.0F) ? 1 : 3;
}

// The strongest along its own gradient.
bool IsRidge(const FloatImage& image, int x, int y, const Gradient& gradient) {
  static constexpr int kDx[kDirections] = {1, 1, 0, -1};
  static constexpr int kDy[kDirections] = {0, 1, 1, 1};
  const int direction = DirectionOf(gradient);
  const int dx = kDx[direction];
  const int dy = kDy[direction];
  const float strength = gradient.SquaredNorm();
  return strength > GradientAt(image, x + dx, y + dy).SquaredNorm() &&
         strength >= GradientAt(image, x - dx, y - dy).SquaredNorm();
}

std::array<std::vector<Edge>, kDirections> FindEdges(const Octave& octave) {
  std::array<std::vector<Edge>, kDirections> edges;
  const FloatImage& fine = octave.levels[kFineLevel];
  const FloatImage& coarse = octave.levels[kCoarseLevel];
  for (int y = kMargin; y < fine.height() - kMargin; y += kStep) {
    for (int x = kMargin; x < fine.width() - kMargin; ++x) {
      const Gradient gradient = GradientAt(fine, x, y);
      const float squared = gradient.SquaredNorm();
      if (squared < kMinSquaredGradient || !IsRidge(fine, x, y, gradient)) continue;
      const float coarse_squared = GradientAt(coarse, x, y).SquaredNorm();
      edges[static_cast<std::size_t>(DirectionOf(gradient))].push_back(
          {squared, squared / std::max(coarse_squared, 1e-6F)});
    }
  }
  return edges;
}

// Of a step blurred by b and then by Gaussians of t1 < t2 the slopes' squared ratio is
// r = (b^2 + t2^2) / (b^2 + t1^2); hence b^2 = (t2^2 - r t1^2) / (r - 1).
double BlurOfRatio(double squared_ratio) {
  const double decoded = 0.25;  // Half a pixel, as the scale space assumes.
  const double fine = std::pow(LevelSigma(kFineLevel), 2) - decoded;
  const double coarse = std::pow(LevelSigma(kCoarseLevel), 2) - decoded;
  if (squared_ratio <= 1.0) return kMaxBlur;
  const double squared_blur = (coarse - squared_ratio * fine) / (squared_ratio - 1.0);
  return std::min(kMaxBlur, std::sqrt(std::max(0.0, squared_blur)));
}

}  // namespace

double EstimateBlur(const Octave& octave) {
  double blur = 0.0;
  for (std::vector<Edge>& edges : FindEdges(octave)) {
    if (edges.size() < kMinEdges) continue;
    // The strongest fifth, and of these the median.
    const auto strong_end = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 5);
    std::nth_element(edges.begin(), strong_end, edges.end(), [](const Edge& a, const Edge& b) {
      return a.squared_strength > b.squared_strength;
    });
    const auto middle = edges.begin() + (strong_end - edges.begin()) / 2;
    std::nth_element(edges.begin(), middle, strong_end, [](const Edge& a, const Edge& b) {
      return a.squared_ratio < b.squared_ratio;
    });
    blur = std::max(blur, BlurOfRatio(static_cast<double>(middle->squared_ratio)));
  }
  return blur * octave.full_px_per_px;
}

}  // namespace plumb
