// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace plumb {
namespace {

TEST(ProblemList, NamesFieldBoundAndValueOfWhatDoesNotHoldOnly) {
  ProblemList problems;
  problems.Require(true, "kept", "positive", 1);
  problems.Require(false, "max_error_px", "positive", -0.5);
  problems.Append("inner", {"count must be at least 1, but is 0"});
  EXPECT_THAT(problems.Take(),
              testing::ElementsAre("max_error_px must be positive, but is -0.5",
                                   "inner.count must be at least 1, but is 0"));
}

TEST(ThrowIfProblems, NamesTheComponentAndEveryProblem) {
  EXPECT_NO_THROW(ThrowIfProblems("matcher", {}));
  try {
    ThrowIfProblems("matcher", {"first", "second"});
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "matcher: first; second");
  }
}

}  // namespace
}  // namespace plumb
