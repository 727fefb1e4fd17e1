// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/gaussian_blur.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "image/parallel_for.h"
#include "image/simd.h"

namespace plumb {
namespace {

constexpr int kRowsPerPart = 32;
constexpr int kBlock = 32;  // Floats worked on at a time; divides the rows' stride.
static_assert(FloatImage::kRowAlignment % kBlock == 0);

// 16 floats that may lie anywhere; the compiler splits them into the registers there are.
typedef float Float16 __attribute__((vector_size(64), aligned(4), may_alias));

const Float16& Load(const float* values) { return *reinterpret_cast<const Float16*>(values); }
Float16& Store(float* values) { return *reinterpret_cast<Float16*>(values); }

// Half of the symmetric kernel: weights[0] is the centre's; they sum to 1.
std::vector<float> HalfKernel(double sigma_px) {
  const int radius = std::max(1, static_cast<int>(std::ceil(4.0 * sigma_px)));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1.0 : 2.0) * weights.back();
  }
  std::vector<float> half;
  for (const double weight : weights) half.push_back(static_cast<float>(weight / sum));
  return half;
}

struct RowFilter {
  const float* weights;
  int radius;
  int width;
  int stride;
};

// rows[0 .. 2 radius]: the source rows around the output row. `padded` has room for
// stride + 2 radius values; `padded` + radius is the row's first pixel.
PLUMB_SIMD_INLINE void FilterRowBody(const RowFilter& filter,
                                     const float* const* rows,
                                     float* padded,
                                     float* out) {
  const int radius = filter.radius;
  float* line = padded + radius;
  for (int x = 0; x < filter.stride; x += kBlock) {
    Float16 sum0 = filter.weights[0] * Load(rows[radius] + x);
    Float16 sum1 = filter.weights[0] * Load(rows[radius] + x + 16);
    for (int i = 1; i <= radius; ++i) {
      const float* above = rows[radius - i] + x;
      const float* below = rows[radius + i] + x;
      sum0 += filter.weights[i] * (Load(above) + Load(below));
      sum1 += filter.weights[i] * (Load(above + 16) + Load(below + 16));
    }
    Store(line + x) = sum0;
    Store(line + x + 16) = sum1;
  }
  for (int i = 1; i <= radius; ++i) {
    line[-i] = line[0];
    line[filter.width - 1 + i] = line[filter.width - 1];
  }
  for (int x = 0; x < filter.stride; x += kBlock) {
    Float16 sum0 = filter.weights[0] * Load(line + x);
    Float16 sum1 = filter.weights[0] * Load(line + x + 16);
    for (int i = 1; i <= radius; ++i) {
      sum0 += filter.weights[i] * (Load(line + x - i) + Load(line + x + i));
      sum1 += filter.weights[i] * (Load(line + x + 16 - i) + Load(line + x + 16 + i));
    }
    Store(out + x) = sum0;
    Store(out + x + 16) = sum1;
  }
}

using FilterRowFunction = void (*)(const RowFilter&, const float* const*, float*, float*);

void FilterRow(const RowFilter& filter, const float* const* rows, float* padded, float* out) {
  FilterRowBody(filter, rows, padded, out);
}

#if defined(__x86_64__)
PLUMB_TARGET_AVX2 void FilterRowAvx2(const RowFilter& filter,
                                     const float* const* rows,
                                     float* padded,
                                     float* out) {
  FilterRowBody(filter, rows, padded, out);
}

PLUMB_TARGET_AVX512 void FilterRowAvx512(const RowFilter& filter,
                                         const float* const* rows,
                                         float* padded,
                                         float* out) {
  FilterRowBody(filter, rows, padded, out);
}
#endif

FilterRowFunction BestFilterRow() {
#if defined(__x86_64__)
  if (DetectSimdLevel() == SimdLevel::kAvx512) return FilterRowAvx512;
  if (DetectSimdLevel() == SimdLevel::kAvx2) return FilterRowAvx2;
#endif
  return FilterRow;
}

}  // namespace

FloatImage BlurGaussian(const FloatImage& image, double sigma_px, int num_threads) {
  const std::vector<float> weights = HalfKernel(sigma_px);
  const RowFilter filter = {
      weights.data(), static_cast<int>(weights.size()) - 1, image.width(), image.stride()};
  const FilterRowFunction filter_row = BestFilterRow();
  FloatImage blurred(image.width(), image.height());
  ParallelFor(num_threads, image.height(), kRowsPerPart, [&](int begin, int end) {
    const int radius = filter.radius;
    std::vector<float> padded(static_cast<std::size_t>(filter.stride + 2 * radius), 0.0F);
    std::vector<const float*> rows(static_cast<std::size_t>(2 * radius + 1));
    for (int y = begin; y < end; ++y) {
      for (int i = -radius; i <= radius; ++i) {
        rows[static_cast<std::size_t>(i + radius)] =
            image.Row(std::clamp(y + i, 0, image.height() - 1));
      }
      filter_row(filter, rows.data(), padded.data(), blurred.Row(y));
      blurred.FillPadding(y);
    }
  });
  return blurred;
}

}  // namespace plumb
