// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/listener_gate.h"

namespace plumb::ros_adapter {

ListenerGate::ListenerGate(int min_listeners, double recorder_wait_s, double start_s)
    : min_listeners_(static_cast<std::uint32_t>(min_listeners)),
      recorder_wait_s_(recorder_wait_s),
      start_s_(start_s) {}

bool ListenerGate::MaySend(std::uint32_t num_listeners, double now_s) {
  if (!IsHeard(num_listeners)) return false;
  if (!IsRecorded(num_listeners) && !IsWaitOver(now_s)) return false;
  has_begun_ = true;
  return true;
}

bool ListenerGate::IsRecordingMissed(std::uint32_t num_listeners, double now_s) const {
  return IsHeard(num_listeners) && !IsRecorded(num_listeners) && IsWaitOver(now_s);
}

bool ListenerGate::IsRecorded(std::uint32_t num_listeners) const {
  return recorder_wait_s_ == 0.0 || num_listeners > min_listeners_;
}

bool ListenerGate::IsWaitOver(double now_s) const {
  return has_begun_ || now_s - start_s_ > recorder_wait_s_;
}

}  // namespace plumb::ros_adapter
