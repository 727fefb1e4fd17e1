// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/listener_gate.h"

#include <gtest/gtest.h>

namespace plumb::ros_adapter {
namespace {

constexpr double kStart_s = 100.0;

TEST(ListenerGate, WaitsForMapperAndDetectorAtAnyTime) {
  ListenerGate gate(2, 0.0, kStart_s);
  EXPECT_FALSE(gate.MaySend(1, kStart_s + 1000.0));
  EXPECT_TRUE(gate.MaySend(2, kStart_s + 1001.0));
  EXPECT_FALSE(gate.MaySend(1, kStart_s + 1002.0));
  EXPECT_FALSE(gate.IsRecordingMissed(2, kStart_s + 1003.0));
}

TEST(ListenerGate, WaitsForTheRecorderAtTheStart) {
  ListenerGate gate(2, 15.0, kStart_s);
  EXPECT_FALSE(gate.MaySend(2, kStart_s + 14.0));
  EXPECT_FALSE(gate.IsRecordingMissed(2, kStart_s + 14.0));
  EXPECT_TRUE(gate.MaySend(3, kStart_s + 14.5));
  EXPECT_FALSE(gate.IsRecordingMissed(3, kStart_s + 14.5));
}

TEST(ListenerGate, GoesOnWithoutARecorderThatDoesNotCome) {
  ListenerGate gate(2, 15.0, kStart_s);
  EXPECT_TRUE(gate.IsRecordingMissed(2, kStart_s + 15.5));
  EXPECT_FALSE(gate.MaySend(1, kStart_s + 15.5));
  EXPECT_TRUE(gate.MaySend(2, kStart_s + 15.5));
}

TEST(ListenerGate, GoesOnWhenTheRecorderEnds) {
  ListenerGate gate(2, 15.0, kStart_s);
  EXPECT_TRUE(gate.MaySend(3, kStart_s + 2.0));
  EXPECT_TRUE(gate.MaySend(2, kStart_s + 3.0));
  EXPECT_TRUE(gate.IsRecordingMissed(2, kStart_s + 3.0));
}

}  // namespace
}  // namespace plumb::ros_adapter
