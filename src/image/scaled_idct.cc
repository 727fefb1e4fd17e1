// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/scaled_idct.h"

#include <algorithm>
#include <cmath>

#include "image/simd.h"

namespace plumb {
namespace {

struct BlockTransform {
  const float* quantization;
  const float (*basis)[kMaxEighths];
  int num_frequencies;
  int num_pixels;
};

// kLanes >= num_pixels: the length of the inner loops, for the compiler to unroll.
template <int kLanes>
PLUMB_SIMD_INLINE void TransformBlock(const BlockTransform& transform,
                                      const std::int16_t* coefficients,
                                      float* out,
                                      int stride) {
  float rows[kDctSize][kLanes];
  for (int k = 0; k < transform.num_frequencies; ++k) {
    float row[kLanes] = {};
    for (int l = 0; l < transform.num_frequencies; ++l) {
      const int idx = k * kDctSize + l;
      const float value = static_cast<float>(coefficients[idx]) * transform.quantization[idx];
      for (int x = 0; x < kLanes; ++x) row[x] += value * transform.basis[l][x];
    }
    std::copy(row, row + kLanes, rows[k]);
  }
  for (int y = 0; y < transform.num_pixels; ++y) {
    float row[kLanes];
    std::fill(row, row + kLanes, 128.0F);  // JPEG's level shift.
    for (int k = 0; k < transform.num_frequencies; ++k) {
      for (int x = 0; x < kLanes; ++x) row[x] += transform.basis[k][y] * rows[k][x];
    }
    std::copy(row, row + transform.num_pixels, out + y * stride);
  }
}

PLUMB_SIMD_INLINE void TransformAny(const BlockTransform& transform,
                                    const std::int16_t* coefficients,
                                    float* out,
                                    int stride) {
  if (transform.num_pixels <= 4) {
    TransformBlock<4>(transform, coefficients, out, stride);
  } else if (transform.num_pixels <= 8) {
    TransformBlock<8>(transform, coefficients, out, stride);
  } else {
    TransformBlock<kMaxEighths>(transform, coefficients, out, stride);
  }
}

#if defined(__x86_64__)
PLUMB_TARGET_AVX2 void TransformAvx2(const BlockTransform& transform,
                                     const std::int16_t* coefficients,
                                     float* out,
                                     int stride) {
  TransformAny(transform, coefficients, out, stride);
}
#endif

}  // namespace

ScaledIdct::ScaledIdct(int eighths, const std::uint16_t* quantization)
    : eighths_(eighths), num_frequencies_(std::min(eighths, kDctSize)) {
  std::copy(quantization, quantization + quantization_.size(), quantization_.begin());
  // The n-point inverse DCT, sqrt((k ? 2 : 1) / n) cos((2 i + 1) k pi / (2 n)), times
  // sqrt(n / 8), which keeps the mean when 8 points' frequencies make n points.
  const double pi = std::acos(-1.0);
  for (int k = 0; k < kDctSize; ++k) {
    const double norm = k == 0 ? std::sqrt(0.125) : 0.5;
    for (int i = 0; i < kMaxEighths; ++i) {
      basis_[k][i] = static_cast<float>(norm * std::cos((2 * i + 1) * k * pi / (2 * eighths)));
    }
  }
}

void ScaledIdct::Decode(const std::int16_t* coefficients, float* out, int stride) const {
  const BlockTransform transform = {quantization_.data(),
                                    reinterpret_cast<const float(*)[kMaxEighths]>(basis_.data()),
                                    num_frequencies_,
                                    eighths_};
#if defined(__x86_64__)
  if (DetectSimdLevel() != SimdLevel::kBaseline) {
    TransformAvx2(transform, coefficients, out, stride);
    return;
  }
#endif
  TransformAny(transform, coefficients, out, stride);
}

}  // namespace plumb
