// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/send_window.h"

#include <gtest/gtest.h>

namespace plumb::ros_adapter {
namespace {

SendWindow WindowOf(std::initializer_list<std::uint32_t> sequences) {
  SendWindow window(/*max_in_flight=*/2, /*resend_after_s=*/10.0);
  for (const std::uint32_t sequence : sequences) window.Add(sequence);
  return window;
}

TEST(SendWindow, SendsTheOldestFirstAndFewAtATime) {
  SendWindow window = WindowOf({3, 1, 2});
  EXPECT_EQ(window.Next(0.0), 1U);
  EXPECT_EQ(window.Next(0.0), 2U);
  EXPECT_EQ(window.Next(0.0), std::nullopt);
  window.Answer(2);
  EXPECT_EQ(window.Next(0.0), 3U);
}

TEST(SendWindow, KnowsTheOldestWithoutAnAnswer) {
  SendWindow window = WindowOf({2, 1, 3});
  EXPECT_EQ(window.Oldest(), 1U);
  window.Next(0.0);
  EXPECT_EQ(window.Oldest(), 1U);  // In flight.
  window.Answer(1);
  EXPECT_EQ(window.Oldest(), 2U);
  window.Answer(2);
  window.Answer(3);
  EXPECT_EQ(window.Oldest(), std::nullopt);
}

TEST(SendWindow, SendsAgainWhatIsNotAnsweredInTime) {
  SendWindow window = WindowOf({1, 2, 3});
  EXPECT_EQ(window.Next(0.0), 1U);
  EXPECT_EQ(window.Next(1.0), 2U);
  EXPECT_EQ(window.Next(9.9), std::nullopt);
  EXPECT_EQ(window.Next(10.5), 1U);
  EXPECT_EQ(window.Next(10.5), std::nullopt);
  EXPECT_EQ(window.Next(11.0), 2U);
  EXPECT_EQ(window.num_sent_again(), 2U);
}

TEST(SendWindow, NeverSendsWhatIsAnswered) {
  SendWindow window = WindowOf({1});
  EXPECT_EQ(window.Next(0.0), 1U);
  window.Answer(1);
  EXPECT_EQ(window.Next(1e6), std::nullopt);
  window.Answer(99);  // Not ours.
  EXPECT_EQ(window.Next(1e6), std::nullopt);
}

TEST(SendWindow, AnAnswerBeforeSendingCounts) {  // By an earlier run of this node.
  SendWindow window = WindowOf({1, 2});
  window.Answer(1);
  EXPECT_EQ(window.Next(0.0), 2U);
}

TEST(SendWindow, ARestartedMapperGetsWhatItDoesNotKnow) {
  SendWindow window = WindowOf({1, 2, 3});
  EXPECT_EQ(window.Next(0.0), 1U);
  window.Answer(1);
  EXPECT_EQ(window.Next(0.0), 2U);
  window.Answer(2);
  EXPECT_EQ(window.Next(0.0), 3U);
  window.Restart({1});  // The verdict of 2 did not reach the disk; 3 was in flight.
  EXPECT_EQ(window.num_in_flight(), 0U);
  EXPECT_EQ(window.Next(0.1), 2U);
  EXPECT_EQ(window.Next(0.1), 3U);
  EXPECT_EQ(window.Next(0.1), std::nullopt);
}

}  // namespace
}  // namespace plumb::ros_adapter
