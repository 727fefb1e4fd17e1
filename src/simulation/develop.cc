// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "image/parallel_for.h"
#include "image/simd.h"
#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/simulation/sensor.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr int kChannels = 3;
constexpr int kRowsPerPart = 32;
constexpr int kBlock = 512;  // Values in work at once: they stay in the first cache.

// A weight of the blur and where its source lies from the value in work.
struct Tap {
  std::ptrdiff_t offset;
  float weight;
};

// Of noise with the variance (signal + floor) / electrons, all in units of white.
struct NoiseLevel {
  float per_signal = 0.0F;
  float floor = 0.0F;
  std::uint32_t seed = 0;
};

// Bits of a counter (Wellons, hash prospector, lowbias32).
PLUMB_SIMD_INLINE std::uint32_t HashCounter(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x7FEB352DU;
  value ^= value >> 15U;
  value *= 0x846CA68BU;
  return value ^ (value >> 16U);
}

// Nearly normal, mean 0 and variance 1: the sum of four uniform bytes (Irwin and Hall), of
// mean 510 and variance 4 (256^2 - 1) / 12. It ends at 3.45 sigma.
PLUMB_SIMD_INLINE float NormalFromBits(std::uint32_t bits) {
  const std::uint32_t pairs = (bits & 0x00FF00FFU) + ((bits >> 8U) & 0x00FF00FFU);
  const auto sum = static_cast<std::int32_t>((pairs & 0xFFFFU) + (pairs >> 16U));
  return (static_cast<float>(sum) - 510.0F) * 6.7658607e-3F;
}

// One block of at most kBlock values: blurred, noisy, times kToneSteps.
constexpr int kToneSteps = 16383;
PLUMB_SIMD_INLINE void DevelopBlockBody(const float* source,
                                        const std::vector<Tap>& taps,
                                        const NoiseLevel& noise,
                                        std::uint32_t counter,
                                        int count,
                                        std::int32_t* tone_idx) {
  std::array<float, kBlock> value{};
  for (const Tap& tap : taps) {
    const float* from = source + tap.offset;
    for (int i = 0; i < count; ++i) value[i] += tap.weight * from[i];
  }
  for (int i = 0; i < count; ++i) {
    const float normal = NormalFromBits(HashCounter((counter + i) ^ noise.seed));
    const float sigma = std::sqrt(value[i] * noise.per_signal + noise.floor);
    const float noisy = (value[i] + sigma * normal) * kToneSteps + 0.5F;
    tone_idx[i] =
        static_cast<std::int32_t>(std::min(std::max(noisy, 0.0F), static_cast<float>(kToneSteps)));
  }
}

using DevelopBlockFunction = void (*)(
    const float*, const std::vector<Tap>&, const NoiseLevel&, std::uint32_t, int, std::int32_t*);

void DevelopBlock(const float* source,
                  const std::vector<Tap>& taps,
                  const NoiseLevel& noise,
                  std::uint32_t counter,
                  int count,
                  std::int32_t* tone_idx) {
  DevelopBlockBody(source, taps, noise, counter, count, tone_idx);
}

#if defined(__x86_64__)
// Without fused multiply-add, so that the bytes are the same on every processor.
__attribute__((target("avx2"))) void DevelopBlockAvx2(const float* source,
                                                      const std::vector<Tap>& taps,
                                                      const NoiseLevel& noise,
                                                      std::uint32_t counter,
                                                      int count,
                                                      std::int32_t* tone_idx) {
  DevelopBlockBody(source, taps, noise, counter, count, tone_idx);
}
#endif

DevelopBlockFunction ChooseDevelopBlock() {
#if defined(__x86_64__)
  if (DetectSimdLevel() != SimdLevel::kBaseline) return DevelopBlockAvx2;
#endif
  return DevelopBlock;
}

// IEC 61966-2-1 (sRGB), by steps of linear light.
std::vector<std::uint8_t> MakeToneTable(bool tone_curve) {
  std::vector<std::uint8_t> table(kToneSteps + 1);
  for (int i = 0; i <= kToneSteps; ++i) {
    const double linear = static_cast<double>(i) / kToneSteps;
    const double curved =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    table[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255.0 * (tone_curve ? curved : linear)));
  }
  return table;
}

// Some rows of the radiance with a border, times gain and vignetting.
class Band {
 public:
  Band(const cv::Mat& radiance, int begin, int end, const cv::Size& border)
      : radiance_(radiance),
        begin_(begin - border.height),
        border_(border),
        stride_(kChannels * (radiance.cols + 2 * border.width)),
        values_(static_cast<std::size_t>(stride_ * (end - begin + 2 * border.height))) {}

  // Light falls by `loss` from the middle to the corner, as the square of the radius.
  void Fill(double gain, double loss) {
    const int num_rows = static_cast<int>(values_.size()) / stride_;
    const double middle_x = 0.5 * (radiance_.cols - 1);
    const double middle_y = 0.5 * (radiance_.rows - 1);
    const double corner2 = middle_x * middle_x + middle_y * middle_y;
    for (int i = 0; i < num_rows; ++i) {
      const int y = std::clamp(begin_ + i, 0, radiance_.rows - 1);
      const double down2 = (y - middle_y) * (y - middle_y);
      const auto in_middle = static_cast<float>(gain * (1.0 - loss * down2 / corner2));
      const auto fall = static_cast<float>(gain * loss / corner2);
      FillRow(radiance_.ptr<float>(y), in_middle, fall, values_.data() + i * stride_);
    }
  }

  // Values of row y of the photo, from its first column.
  const float* Row(int y) const {
    return values_.data() + (y - begin_) * stride_ + kChannels * border_.width;
  }
  int stride() const { return stride_; }

 private:
  void FillRow(const float* from, float in_middle, float fall, float* to) const {
    const auto middle_x = 0.5F * static_cast<float>(radiance_.cols - 1);
    float* first = to + kChannels * border_.width;
    for (int x = 0; x < radiance_.cols; ++x) {
      const float right = static_cast<float>(x) - middle_x;
      const float factor = in_middle - fall * right * right;
      // Light below zero, or no number, would have no noise, and no tone then.
      for (int c = 0; c < kChannels; ++c)
        first[kChannels * x + c] = std::max(0.0F, factor * from[kChannels * x + c]);
    }
    const float* last = first + kChannels * (radiance_.cols - 1);
    for (int i = 0; i < kChannels * border_.width; ++i) {
      to[i] = first[i % kChannels];
      first[kChannels * radiance_.cols + i] = last[i % kChannels];
    }
  }

  const cv::Mat& radiance_;
  int begin_;
  cv::Size border_;
  int stride_;
  std::vector<float> values_;
};

std::vector<Tap> MakeTaps(const cv::Mat& kernel, int stride) {
  std::vector<Tap> taps;
  for (int y = 0; y < kernel.rows; ++y) {
    for (int x = 0; x < kernel.cols; ++x) {
      const std::ptrdiff_t offset =
          std::ptrdiff_t{y - kernel.rows / 2} * stride + kChannels * (x - kernel.cols / 2);
      const float weight = kernel.at<float>(y, x);
      if (weight > 1e-5F) taps.push_back({offset, weight});
    }
  }
  return taps;
}

NoiseLevel MakeNoise(const SensorOptions& options, int iso, std::uint64_t seed) {
  NoiseLevel noise;
  if (!options.noise) return noise;
  const double electrons = options.full_well_electrons * 100.0 / iso;
  const double read = options.read_noise_electrons / electrons;
  noise.per_signal = static_cast<float>(1.0 / electrons);
  noise.floor = static_cast<float>(read * read);
  noise.seed = static_cast<std::uint32_t>(MixBits(seed));
  return noise;
}

}  // namespace

cv::Mat ExposePhoto(const SensorOptions& options,
                    const Camera& camera,
                    const cv::Mat& radiance,
                    const Exposure& exposure,
                    const ShotConditions& conditions,
                    int num_threads) {
  ThrowIfProblems("sensor", options.Problems());
  PLUMB_CHECK(radiance.type() == CV_32FC3 && !radiance.empty());
  const cv::Mat kernel = BlurKernel(options, camera, exposure, conditions);
  const NoiseLevel noise = MakeNoise(options, exposure.iso, conditions.noise_seed);
  const std::vector<std::uint8_t> tones = MakeToneTable(options.tone_curve);
  const DevelopBlockFunction develop_block = ChooseDevelopBlock();
  const int row_values = kChannels * radiance.cols;
  cv::Mat picture(radiance.size(), CV_8UC3);
  ParallelFor(num_threads, radiance.rows, kRowsPerPart, [&](int begin, int end) {
    Band band(radiance, begin, end, {kernel.cols / 2, kernel.rows / 2});
    band.Fill(exposure.gain, options.vignetting);
    const std::vector<Tap> taps = MakeTaps(kernel, band.stride());
    std::array<std::int32_t, kBlock> tone_idx{};
    for (int y = begin; y < end; ++y) {
      std::uint8_t* out = picture.ptr<std::uint8_t>(y);
      for (int first = 0; first < row_values; first += kBlock) {
        const int count = std::min(kBlock, row_values - first);
        const auto counter = static_cast<std::uint32_t>(y * row_values + first);
        develop_block(band.Row(y) + first, taps, noise, counter, count, tone_idx.data());
        for (int i = 0; i < count; ++i) {
          out[first + i] = tones[static_cast<std::size_t>(tone_idx[static_cast<std::size_t>(i)])];
        }
      }
    }
  });
  return picture;
}

}  // namespace plumb
