// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/trouble.h"

#include <gtest/gtest.h>

namespace plumb::ros_adapter {
namespace {

TEST(Trouble, IsSaidAtItsBeginningAndOnceAMinute) {
  Trouble trouble;
  EXPECT_TRUE(trouble.Set("the disk is full", 1, 1000.0));
  int num_said = 0;
  for (double now_s = 1001.0; now_s <= 1180.0; now_s += 1.0) {
    num_said += trouble.Set("the disk is full", 1, now_s) ? 1 : 0;
  }
  EXPECT_EQ(num_said, 3);
}

TEST(Trouble, IsOneTroubleWhateverPhotoItNames) {
  Trouble trouble;
  EXPECT_TRUE(trouble.Set("cannot write a.jpg", 1, 0.0));
  EXPECT_FALSE(trouble.Set("cannot write b.jpg", 2, 1.0));
  EXPECT_EQ(trouble.text(), "cannot write b.jpg");
}

TEST(Trouble, TellsAtItsEndOnceHowManyPhotosWaited) {
  Trouble trouble;
  EXPECT_EQ(trouble.Clear(), std::nullopt);
  trouble.Set("the disk is full", 3, 0.0);
  trouble.Set("the disk is full", 5, 1.0);
  trouble.Set("the disk is full", 1, 2.0);
  EXPECT_EQ(trouble.Clear(), 5U);
  EXPECT_EQ(trouble.text(), "");
  EXPECT_EQ(trouble.Clear(), std::nullopt);
}

TEST(Trouble, IsSaidAtOnceWhenItComesAgain) {
  Trouble trouble;
  EXPECT_TRUE(trouble.Set("the disk is full", 1, 0.0));
  trouble.Clear();
  EXPECT_TRUE(trouble.Set("the disk is full", 1, 5.0));
}

}  // namespace
}  // namespace plumb::ros_adapter
