// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(Check, ABrokenOneThrowsWithTheExpressionAndItsValues) {
  const int have = 3;
  try {
    PLUMB_CHECK_GE(have, 4);
    FAIL() << "must throw";
  } catch (const std::logic_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("have >= 4 (3 against 4)"));
    EXPECT_THAT(error.what(), testing::HasSubstr("check_test.cc"));
  }
}

TEST(Check, AKeptOneIsSilentAndEvaluatesOnce) {
  int calls = 0;
  PLUMB_CHECK_EQ(++calls, 1);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace plumb
