// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/map/verdict_wording.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(DescribeAgreement, CountsLandmarksOnceLocatedAndElsePartsOfTheMatches) {
  PhotoVerdict verdict;
  EXPECT_EQ(DescribeAgreement(verdict), "");
  verdict.num_matches = 94;
  verdict.num_inliers = 12;
  verdict.status = VerdictStatus::kRefused;
  EXPECT_EQ(DescribeAgreement(verdict), "12 of 94 matches agree");
  verdict.num_inliers = 141;  // The pose has led to more than were tried.
  verdict.status = VerdictStatus::kAccepted;
  EXPECT_EQ(DescribeAgreement(verdict), "141 landmarks agree");
}

}  // namespace
}  // namespace plumb
