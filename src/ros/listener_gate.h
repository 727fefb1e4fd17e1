// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace plumb::ros_adapter {

// Whether enough nodes listen for photos to be sent. The first photo waits for the recorder as
// well, but not for long: a flight does not end with its recording, nor wait for it once it has
// begun. Times are seconds of any steady clock. Thread-safe.
class ListenerGate {
 public:
  // `recorder_wait_s` 0: there is no recorder.
  ListenerGate(int min_listeners, double recorder_wait_s, double start_s);

  // The flight has begun once this was true.
  bool MaySend(std::uint32_t num_listeners, double now_s);

  bool IsHeard(std::uint32_t num_listeners) const { return num_listeners >= min_listeners_; }

  // The flight goes on, or would, without the recorder that there should be.
  bool IsRecordingMissed(std::uint32_t num_listeners, double now_s) const;

 private:
  bool IsRecorded(std::uint32_t num_listeners) const;
  bool IsWaitOver(double now_s) const;

  const std::uint32_t min_listeners_;
  const double recorder_wait_s_;
  const double start_s_;
  std::atomic<bool> has_begun_{false};
};

}  // namespace plumb::ros_adapter
