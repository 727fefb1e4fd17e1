// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace plumb::ros_adapter {

// Decides which photo to send when: the oldest first, few at a time, again what was not
// answered. Times are seconds of any steady clock. Not thread-safe.
class SendWindow {
 public:
  // At most `max_in_flight` photos are sent and not yet answered; one that was not answered
  // for `resend_after_s` is sent again.
  SendWindow(int max_in_flight, double resend_after_s)
      : max_in_flight_(max_in_flight), resend_after_s_(resend_after_s) {}

  void Add(std::uint32_t sequence) { pending_.insert(sequence); }

  // The photo has its verdict. Unknown ones are ignored.
  void Answer(std::uint32_t sequence);

  // A mapper started that knows the answers of `stored` only: all others are to be sent again.
  void Restart(const std::vector<std::uint32_t>& stored);

  // The photo to send now, counted as sent; nothing if there is none or too many are in flight.
  std::optional<std::uint32_t> Next(double now_s);

  // The first of the photos that have no answer yet.
  std::optional<std::uint32_t> Oldest() const;

  std::size_t num_waiting() const { return pending_.size(); }
  std::size_t num_in_flight() const { return sent_s_.size(); }
  std::size_t num_sent_again() const { return num_sent_again_; }  // For want of an answer.

 private:
  int max_in_flight_;
  double resend_after_s_;
  std::set<std::uint32_t> pending_;         // To be sent.
  std::map<std::uint32_t, double> sent_s_;  // In flight, with the time of sending.
  std::set<std::uint32_t> answered_;
  std::size_t num_sent_again_ = 0;
};

}  // namespace plumb::ros_adapter
