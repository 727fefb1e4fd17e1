// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace plumb {
namespace {

// A function for a stage that stands still in its first item until told to go on.
class Gate {
 public:
  void Enter() {
    if (entered_once_) return;
    entered_once_ = true;
    entered_.set_value();
    open_.get_future().wait();
  }
  void WaitUntilEntered() { entered_.get_future().wait(); }
  void Open() { open_.set_value(); }

 private:
  bool entered_once_ = false;
  std::promise<void> entered_;
  std::promise<void> open_;
};

TEST(Stage, ProcessesEveryItemInOrder) {
  std::vector<int> seen;
  Stage<int> stage(3, [&](int item) { seen.push_back(item); });
  std::vector<int> items(1000);
  std::iota(items.begin(), items.end(), 0);
  for (const int item : items) EXPECT_TRUE(stage.Push(item));
  stage.Close();
  EXPECT_EQ(seen, items);
  const StageCounters counters = stage.counters();
  EXPECT_EQ(counters.accepted, 1000u);
  EXPECT_EQ(counters.processed, 1000u);
  EXPECT_EQ(counters.dropped, 0u);
  EXPECT_EQ(counters.queue_depth, 0u);
  EXPECT_GE(counters.max_queue_depth, 1u);
  EXPECT_LE(counters.max_queue_depth, 3u);
}

TEST(Stage, TryPushDropsAndCountsWhenTheQueueIsFull) {
  Gate gate;
  std::vector<int> seen;
  Stage<int> stage(2, [&](int item) {
    gate.Enter();
    seen.push_back(item);
  });
  EXPECT_TRUE(stage.TryPush(0));
  gate.WaitUntilEntered();  // Item 0 has left the queue.
  EXPECT_TRUE(stage.TryPush(1));
  EXPECT_TRUE(stage.TryPush(2));
  EXPECT_FALSE(stage.TryPush(3));
  EXPECT_EQ(stage.counters().queue_depth, 2u);
  EXPECT_EQ(stage.counters().dropped, 1u);
  gate.Open();
  stage.Close();
  EXPECT_THAT(seen, testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(stage.counters().max_queue_depth, 2u);
}

TEST(Stage, PushWaitsForRoomAndLosesNothing) {
  Gate gate;
  std::vector<int> seen;
  Stage<int> stage(1, [&](int item) {
    gate.Enter();
    seen.push_back(item);
  });
  stage.Push(0);
  gate.WaitUntilEntered();
  stage.Push(1);  // The queue is full now.
  std::promise<void> about_to_push;
  std::thread producer([&] {
    about_to_push.set_value();
    EXPECT_TRUE(stage.Push(2));
  });
  about_to_push.get_future().wait();
  EXPECT_EQ(stage.counters().accepted, 2u);
  gate.Open();
  producer.join();
  stage.Close();
  EXPECT_THAT(seen, testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(stage.counters().max_queue_depth, 1u);
}

TEST(Stage, CloseRethrowsWhatTheFunctionThrewOnce) {
  Stage<int> stage(1, [](int) { throw std::runtime_error("disk is full"); });
  EXPECT_TRUE(stage.Push(0));
  try {
    stage.Close();
    FAIL() << "Close must rethrow";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "disk is full");
  }
  EXPECT_NO_THROW(stage.Close());
}

TEST(Stage, AFailureReleasesBlockedProducersAndCountsWhatIsLost) {
  Gate gate;
  Stage<int> stage(1, [&](int) {
    gate.Enter();
    throw std::runtime_error("failed");
  });
  stage.Push(0);
  gate.WaitUntilEntered();
  stage.Push(1);
  std::thread producer([&] { EXPECT_FALSE(stage.Push(2)); });  // Full, then failed.
  gate.Open();
  producer.join();
  EXPECT_THROW(stage.Close(), std::runtime_error);
  const StageCounters counters = stage.counters();
  EXPECT_EQ(counters.accepted, 2u);
  EXPECT_EQ(counters.processed, 0u);
  EXPECT_EQ(counters.dropped, 3u);
}

TEST(Stage, TakesNothingAfterClose) {
  int sum = 0;
  Stage<int> stage(1, [&](int item) { sum += item; });
  stage.Push(1);
  stage.Close();
  EXPECT_FALSE(stage.Push(2));
  EXPECT_FALSE(stage.TryPush(4));
  EXPECT_EQ(sum, 1);
  EXPECT_EQ(stage.counters().dropped, 2u);
}

TEST(Stage, TheDestructorDrainsTheQueue) {
  int sum = 0;
  {
    Stage<int> stage(100, [&](int item) { sum += item; });
    for (int i = 1; i <= 100; ++i) stage.Push(i);
  }
  EXPECT_EQ(sum, 5050);
}

TEST(Stage, CarriesItemsThatCannotBeCopied) {
  int sum = 0;
  Stage<std::unique_ptr<int>> stage(1, [&](std::unique_ptr<int> item) { sum += *item; });
  stage.Push(std::make_unique<int>(7));
  stage.Close();
  EXPECT_EQ(sum, 7);
}

TEST(Stage, AQueueWithoutRoomIsABrokenPrecondition) {
  EXPECT_THROW(Stage<int>(0, [](int) {}), std::logic_error);
}

}  // namespace
}  // namespace plumb
