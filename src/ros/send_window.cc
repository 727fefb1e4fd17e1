// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/send_window.h"

#include <algorithm>

namespace plumb::ros_adapter {

void SendWindow::Answer(std::uint32_t sequence) {
  if (pending_.erase(sequence) + sent_s_.erase(sequence) > 0) answered_.insert(sequence);
}

void SendWindow::Restart(const std::vector<std::uint32_t>& stored) {
  for (const auto& [sequence, sent_s] : sent_s_) pending_.insert(sequence);
  sent_s_.clear();
  pending_.insert(answered_.begin(), answered_.end());
  answered_.clear();
  for (const std::uint32_t sequence : stored) Answer(sequence);
}

std::optional<std::uint32_t> SendWindow::Next(double now_s) {
  for (auto& [sequence, sent_s] : sent_s_) {
    if (now_s - sent_s < resend_after_s_) continue;
    sent_s = now_s;
    ++num_sent_again_;
    return sequence;
  }
  if (pending_.empty() || sent_s_.size() >= static_cast<std::size_t>(max_in_flight_)) return {};
  const std::uint32_t sequence = *pending_.begin();
  pending_.erase(pending_.begin());
  sent_s_[sequence] = now_s;
  return sequence;
}

std::optional<std::uint32_t> SendWindow::Oldest() const {
  std::optional<std::uint32_t> oldest;
  if (!pending_.empty()) oldest = *pending_.begin();
  if (!sent_s_.empty())
    oldest = std::min(oldest.value_or(sent_s_.begin()->first), sent_s_.begin()->first);
  return oldest;
}

}  // namespace plumb::ros_adapter
