// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace plumb {

constexpr int kDctSize = 8;      // Of a JPEG block.
constexpr int kMaxEighths = 16;  // Largest scale: doubling.

// Inverse DCT of JPEG blocks to n x n pixels, n of 1 to 16: decodes the picture at n/8 of its
// size. For n < 8 only the lowest n x n frequencies count, as in libjpeg's scaled decoding;
// for n > 8 the block is interpolated by its own cosines.
class ScaledIdct {
 public:
  // `quantization`: the table of the component, row by row.
  ScaledIdct(int eighths, const std::uint16_t* quantization);

  // Writes the grey values of a block (0 to 255, but not clamped) to `out`, rows `stride`
  // floats apart, `kMaxEighths` floats of each row at most.
  void Decode(const std::int16_t* coefficients, float* out, int stride) const;

 private:
  int eighths_;
  int num_frequencies_;
  std::array<float, kDctSize * kDctSize> quantization_;
  // basis_[k][i]: value of frequency k at pixel i.
  std::array<std::array<float, kMaxEighths>, kDctSize> basis_;
};

}  // namespace plumb
