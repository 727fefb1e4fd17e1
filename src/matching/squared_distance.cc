// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/matching/descriptor_matcher.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace plumb {
namespace {

using SquaredDistanceFunction = std::int32_t (*)(const std::uint8_t*, const std::uint8_t*);

std::int32_t PortableSquaredDistance(const std::uint8_t* descriptor1,
                                     const std::uint8_t* descriptor2) {
  std::int32_t sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) {
    const auto difference = static_cast<std::int16_t>(descriptor1[k] - descriptor2[k]);
    sum += difference * difference;
  }
  return sum;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) std::int32_t Avx2SquaredDistance(const std::uint8_t* descriptor1,
                                                                 const std::uint8_t* descriptor2) {
  __m256i sums = _mm256_setzero_si256();
  for (int k = 0; k < kDescriptorSize; k += 16) {
    const __m256i part1 =
        _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(descriptor1 + k)));
    const __m256i part2 =
        _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(descriptor2 + k)));
    const __m256i difference = _mm256_sub_epi16(part1, part2);
    sums = _mm256_add_epi32(sums, _mm256_madd_epi16(difference, difference));
  }
  __m128i four = _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  four = _mm_add_epi32(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(1, 0, 3, 2)));
  four = _mm_add_epi32(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(2, 3, 0, 1)));
  return _mm_cvtsi128_si32(four);
}
#endif

SquaredDistanceFunction SelectSquaredDistance() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0) return &Avx2SquaredDistance;
#endif
  return &PortableSquaredDistance;
}

}  // namespace

std::int32_t SquaredDistance(const std::uint8_t* descriptor1, const std::uint8_t* descriptor2) {
  static const SquaredDistanceFunction function = SelectSquaredDistance();
  return function(descriptor1, descriptor2);
}

}  // namespace plumb
