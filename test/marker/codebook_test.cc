// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/marker/codebook.h"

#include <gtest/gtest.h>

#include <bitset>
#include <stdexcept>

#include "plumbline/marker/marker_layout.h"

namespace plumb {
namespace {

int Distance(std::uint32_t a, std::uint32_t b) {
  return static_cast<int>(std::bitset<32>(a ^ b).count());
}

TEST(MarkerCodebook, HoldsAHundredIdsWhoseFirstAndLastStayAsPrinted) {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  EXPECT_EQ(codebook.size(), 106);
  EXPECT_EQ(codebook.Word(0), 1039U);
  EXPECT_EQ(codebook.Word(105), 30645U);
}

TEST(MarkerCodebook, NoTwoCodesComeNearerThanFourBitsAtAnyRotationNorACodeToItself) {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  for (int a = 0; a < codebook.size(); ++a) {
    for (int b = a; b < codebook.size(); ++b) {
      for (int cells = a == b ? 1 : 0; cells < kNumCodeBits; ++cells) {
        EXPECT_GE(Distance(codebook.Word(a), RotateWord(codebook.Word(b), cells)), 4);
      }
    }
  }
}

TEST(MarkerCodebook, CorrectsEveryOneBitErrorAndNoticesEveryTwoAtEveryRotation) {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  for (int id = 0; id < codebook.size(); ++id) {
    for (int cells = 0; cells < kNumCodeBits; ++cells) {
      const std::uint32_t read = RotateWord(codebook.Word(id), cells);
      const auto exact = codebook.Find(read);
      ASSERT_TRUE(exact && exact->id == id && exact->rotation == cells && exact->num_errors == 0);
      for (int i = 0; i < kNumCodeBits; ++i) {
        const auto one = codebook.Find(read ^ (1U << i));
        ASSERT_TRUE(one && one->id == id && one->rotation == cells && one->num_errors == 1);
        for (int j = i + 1; j < kNumCodeBits; ++j) {
          ASSERT_FALSE(codebook.Find(read ^ (1U << i) ^ (1U << j)));
        }
      }
    }
  }
}

TEST(MarkerCodebook, TheMirrorImageOfACodeIsItselfOrNone) {
  const MarkerCodebook& codebook = MarkerCodebook::Get();
  for (int id = 0; id < codebook.size(); ++id) {
    std::uint32_t mirrored = 0;
    for (int i = 0; i < kNumCodeBits; ++i) {
      if (((codebook.Word(id) >> i) & 1U) != 0) mirrored |= 1U << (kNumCodeBits - 1 - i);
    }
    const auto match = codebook.Find(mirrored);
    EXPECT_TRUE(!match || match->id == id);
  }
}

TEST(MarkerCodebook, RotatingAllTheWayGivesTheWordBack) {
  EXPECT_EQ(RotateWord(0x155, kNumCodeBits), 0x155U);
  EXPECT_EQ(RotateWord(RotateWord(0x1F0F, 5), kNumCodeBits - 5), 0x1F0FU);
  EXPECT_EQ(RotateWord(1, 3), 8U);
}

TEST(MarkerCodebook, RefusesAnIdThatDoesNotExist) {
  EXPECT_THROW(MarkerCodebook::Get().Word(-1), std::logic_error);
  EXPECT_THROW(MarkerCodebook::Get().Word(MarkerCodebook::Get().size()), std::logic_error);
}

}  // namespace
}  // namespace plumb
