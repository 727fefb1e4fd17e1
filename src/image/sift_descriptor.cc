// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/sift_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/simd.h"
#include "plumbline/image/features.h"

namespace plumb {
namespace {

constexpr float kPi = 3.14159265358979F;
constexpr float kSampleStep = 0.75F;  // In sigmas.
constexpr int kCells = 4;
constexpr int kDirections = 8;
constexpr int kSamplesPerCell = 4;                        // 3 sigma / kSampleStep.
constexpr int kGrid = (kCells + 1) * kSamplesPerCell;     // With half a cell around.
constexpr int kSupport = 2 * kSamplesPerCell;             // Samples along one side of a tent.
constexpr float kMaxComponent = 0.2F;                     // Lowe, section 6.1.
constexpr int kOrientationGrid = 13;                      // To 3 times the window's 1.5 sigma.
constexpr float kOrientationWindow = 1.5F / kSampleStep;  // In samples.
constexpr int kOrientationBins = 36;
constexpr float kSecondPeak = 0.8F;
constexpr int kMaxOrientations = 2;

using DirectionVector = float __attribute__((vector_size(32), aligned(32)));
static_assert(sizeof(DirectionVector) == kDirections * sizeof(float));

// Samples `image` bilinearly on a kSize x kSize grid around the frame, its
// columns along (step_x, step_y); beyond the border the border pixel is repeated.
template <int kSize>
PLUMB_SIMD_INLINE void SamplePatch(const FloatImage& image,
                                   const PatchFrame& frame,
                                   float step_x,
                                   float step_y,
                                   float (*patch)[kSize]) {
  const float max_x = static_cast<float>(image.width() - 1) - 1e-3F;
  const float max_y = static_cast<float>(image.height() - 1) - 1e-3F;
  const int stride = image.stride();
  const float* pixels = image.Row(0);
  for (int j = 0; j < kSize; ++j) {
    const float v = static_cast<float>(j) - 0.5F * (kSize - 1);
    for (int i = 0; i < kSize; ++i) {
      const float u = static_cast<float>(i) - 0.5F * (kSize - 1);
      const float x = std::min(std::max(frame.x + u * step_x - v * step_y, 0.0F), max_x);
      const float y = std::min(std::max(frame.y + u * step_y + v * step_x, 0.0F), max_y);
      const int x0 = static_cast<int>(x);
      const int y0 = static_cast<int>(y);
      const float fx = x - static_cast<float>(x0);
      const float fy = y - static_cast<float>(y0);
      const int idx = y0 * stride + x0;
      const float top = pixels[idx] + fx * (pixels[idx + 1] - pixels[idx]);
      const float bottom =
          pixels[idx + stride] + fx * (pixels[idx + stride + 1] - pixels[idx + stride]);
      patch[j][i] = top + fy * (bottom - top);
    }
  }
}

// atan2 to 1e-4 rad, without branches: a polynomial on [0, 1] (Abramowitz & Stegun 4.4.47).
PLUMB_SIMD_INLINE float FastAtan2(float y, float x) {
  const float size_x = std::abs(x);
  const float size_y = std::abs(y);
  const float larger = size_x > size_y ? size_x : size_y;
  const float smaller = size_x > size_y ? size_y : size_x;
  const float ratio = smaller / (larger + 1e-20F);
  const float square = ratio * ratio;
  float angle =
      ratio * (0.9998660F +
               square * (-0.3302995F +
                         square * (0.1801410F + square * (-0.0851330F + square * 0.0208351F))));
  angle = size_y > size_x ? 0.5F * kPi - angle : angle;
  angle = x < 0.0F ? kPi - angle : angle;
  return y < 0.0F ? -angle : angle;
}

// Length (times `window`) and direction of the gradients inside a patch of kSize + 2 samples; the
// direction in parts of `num_parts` to a turn, in [0, num_parts].
template <int kSize>
PLUMB_SIMD_INLINE void ComputeGradients(const float (*patch)[kSize + 2],
                                        const float (*window)[kSize],
                                        float num_parts,
                                        float (*length)[kSize],
                                        float (*direction)[kSize]) {
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const float gx = patch[j + 1][i + 2] - patch[j + 1][i];
      const float gy = patch[j + 2][i + 1] - patch[j][i + 1];
      const float angle = FastAtan2(gy, gx);
      const float turn = angle < 0.0F ? angle + 2.0F * kPi : angle;
      direction[j][i] = turn * (num_parts / (2.0F * kPi));
      length[j][i] = std::sqrt(gx * gx + gy * gy) * window[j][i];
    }
  }
}

template <int kSize>
struct Window {
  float weights[kSize][kSize];
  explicit Window(float sigma_samples) {
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        const float u = static_cast<float>(i) - 0.5F * (kSize - 1);
        const float v = static_cast<float>(j) - 0.5F * (kSize - 1);
        weights[j][i] = std::exp(-0.5F * (u * u + v * v) / (sigma_samples * sigma_samples));
      }
    }
  }
};

using OrientationHistogram = std::array<float, kOrientationBins>;

PLUMB_SIMD_INLINE void FillOrientationHistogramBody(const FloatImage& image,
                                                    const PatchFrame& frame,
                                                    OrientationHistogram* histogram) {
  static const Window<kOrientationGrid> window(kOrientationWindow);
  float patch[kOrientationGrid + 2][kOrientationGrid + 2];
  SamplePatch<kOrientationGrid + 2>(image, frame, kSampleStep * frame.sigma, 0.0F, patch);
  float length[kOrientationGrid][kOrientationGrid];
  float direction[kOrientationGrid][kOrientationGrid];
  ComputeGradients<kOrientationGrid>(
      patch, window.weights, static_cast<float>(kOrientationBins), length, direction);
  histogram->fill(0.0F);
  for (int j = 0; j < kOrientationGrid; ++j) {
    for (int i = 0; i < kOrientationGrid; ++i) {
      const int bin = static_cast<int>(direction[j][i]);
      const float part = direction[j][i] - static_cast<float>(bin);
      (*histogram)[static_cast<std::size_t>(bin % kOrientationBins)] += length[j][i] * (1 - part);
      (*histogram)[static_cast<std::size_t>((bin + 1) % kOrientationBins)] += length[j][i] * part;
    }
  }
}

// Adds up the samples' direction vectors by cell, each weighed by its distance from the cell's
// centre along both axes (trilinear interpolation, Lowe, section 6.1).
PLUMB_SIMD_INLINE void GatherCells(const DirectionVector (*samples)[kGrid],
                                   DirectionVector (*cells)[kCells]) {
  float tent[kSupport];
  for (int i = 0; i < kSupport; ++i) {
    tent[i] = 1.0F - std::abs(static_cast<float>(i) - 0.5F * (kSupport - 1)) / kSamplesPerCell;
  }
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) cells[r][c] = DirectionVector{};
  }
  for (int j = 0; j < kGrid; ++j) {
    for (int c = 0; c < kCells; ++c) {
      DirectionVector sum = {};
      for (int i = 0; i < kSupport; ++i) sum += tent[i] * samples[j][c * kSamplesPerCell + i];
      const int last_row = std::min(j / kSamplesPerCell, kCells - 1);
      for (int r = std::max(0, j / kSamplesPerCell - 1); r <= last_row; ++r) {
        cells[r][c] += tent[j - r * kSamplesPerCell] * sum;
      }
    }
  }
}

PLUMB_SIMD_INLINE void FillCellsBody(const FloatImage& image,
                                     const PatchFrame& frame,
                                     float orientation_rad,
                                     float* histogram) {
  // The window's sigma is half the width of the descriptor.
  static const Window<kGrid> window(0.5F * kCells * kSamplesPerCell);
  const float step = kSampleStep * frame.sigma;
  float patch[kGrid + 2][kGrid + 2];
  SamplePatch<kGrid + 2>(
      image, frame, step * std::cos(orientation_rad), step * std::sin(orientation_rad), patch);
  float length[kGrid][kGrid];
  float direction[kGrid][kGrid];
  ComputeGradients<kGrid>(
      patch, window.weights, static_cast<float>(kDirections), length, direction);
  DirectionVector samples[kGrid][kGrid];
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      float shares[kDirections];
      for (int b = 0; b < kDirections; ++b) {
        const float apart = std::abs(direction[j][i] - static_cast<float>(b));
        const float around = std::min(apart, static_cast<float>(kDirections) - apart);
        shares[b] = length[j][i] * std::max(0.0F, 1.0F - around);
      }
      __builtin_memcpy(&samples[j][i], shares, sizeof(shares));
    }
  }
  DirectionVector cells[kCells][kCells];
  GatherCells(samples, cells);
  __builtin_memcpy(histogram, cells, sizeof(cells));
}

void FillCells(const FloatImage& image, const PatchFrame& frame, float angle_rad, float* cells) {
  FillCellsBody(image, frame, angle_rad, cells);
}
void FillOrientationHistogram(const FloatImage& image,
                              const PatchFrame& frame,
                              OrientationHistogram* histogram) {
  FillOrientationHistogramBody(image, frame, histogram);
}

#if defined(__x86_64__)
PLUMB_TARGET_AVX2 void FillCellsAvx2(const FloatImage& image,
                                     const PatchFrame& frame,
                                     float angle_rad,
                                     float* cells) {
  FillCellsBody(image, frame, angle_rad, cells);
}
PLUMB_TARGET_AVX2 void FillOrientationHistogramAvx2(const FloatImage& image,
                                                    const PatchFrame& frame,
                                                    OrientationHistogram* histogram) {
  FillOrientationHistogramBody(image, frame, histogram);
}
#endif

// Circular smoothing by (1 4 6 4 1) / 16.
OrientationHistogram Smooth(const OrientationHistogram& raw) {
  OrientationHistogram smooth;
  const auto at = [&](int bin) {
    return raw[static_cast<std::size_t>((bin + kOrientationBins) % kOrientationBins)];
  };
  for (int b = 0; b < kOrientationBins; ++b) {
    smooth[static_cast<std::size_t>(b)] =
        (at(b - 2) + at(b + 2) + 4 * (at(b - 1) + at(b + 1)) + 6 * at(b)) / 16.0F;
  }
  return smooth;
}

void ToRootSift(float* cells, std::uint8_t* descriptor) {
  float squares = 0.0F;
  for (int i = 0; i < kDescriptorSize; ++i) squares += cells[i] * cells[i];
  const float bound = kMaxComponent * std::sqrt(squares);
  float sum = 0.0F;
  for (int i = 0; i < kDescriptorSize; ++i) {
    cells[i] = std::min(cells[i], bound);
    sum += cells[i];
  }
  const float scale = sum > 0.0F ? 1.0F / sum : 0.0F;
  for (int i = 0; i < kDescriptorSize; ++i) {
    const float value = std::min(255.0F, 512.0F * std::sqrt(cells[i] * scale) + 0.5F);
    descriptor[i] = static_cast<std::uint8_t>(value);
  }
}

}  // namespace

std::vector<float> FindOrientations(const FloatImage& image, const PatchFrame& frame) {
  OrientationHistogram raw;
#if defined(__x86_64__)
  if (DetectSimdLevel() != SimdLevel::kBaseline) {
    FillOrientationHistogramAvx2(image, frame, &raw);
  } else {
    FillOrientationHistogram(image, frame, &raw);
  }
#else
  FillOrientationHistogram(image, frame, &raw);
#endif
  const OrientationHistogram histogram = Smooth(raw);
  const auto at = [&](int bin) {
    return histogram[static_cast<std::size_t>((bin + kOrientationBins) % kOrientationBins)];
  };
  const float bound = kSecondPeak * *std::max_element(histogram.begin(), histogram.end());
  std::vector<std::pair<float, float>> peaks;  // Height, direction.
  for (int b = 0; b < kOrientationBins; ++b) {
    const float height = at(b);
    if (height < bound || height <= at(b - 1) || height < at(b + 1)) continue;
    const float offset = 0.5F * (at(b - 1) - at(b + 1)) / (at(b - 1) - 2 * height + at(b + 1));
    const float turn = (static_cast<float>(b) + offset) / kOrientationBins;
    peaks.emplace_back(height, 2.0F * kPi * (turn > 0.5F ? turn - 1.0F : turn));
  }
  std::stable_sort(
      peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (peaks.size() > kMaxOrientations) peaks.resize(kMaxOrientations);
  std::vector<float> orientations;
  for (const auto& peak : peaks) orientations.push_back(peak.second);
  return orientations;
}

void DescribePatch(const FloatImage& image,
                   const PatchFrame& frame,
                   float orientation_rad,
                   std::uint8_t* descriptor) {
  float cells[kDescriptorSize];
#if defined(__x86_64__)
  if (DetectSimdLevel() != SimdLevel::kBaseline) {
    FillCellsAvx2(image, frame, orientation_rad, cells);
    ToRootSift(cells, descriptor);
    return;
  }
#endif
  FillCells(image, frame, orientation_rad, cells);
  ToRootSift(cells, descriptor);
}

}  // namespace plumb
