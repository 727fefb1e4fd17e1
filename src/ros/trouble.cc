// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/trouble.h"

#include <algorithm>

namespace plumb::ros_adapter {
namespace {

constexpr double kRemindEvery_s = 60.0;

}  // namespace

bool Trouble::Set(const std::string& text, std::size_t num_waiting, double now_s) {
  const bool is_new = text_.empty();
  text_ = text;
  max_waiting_ = std::max(max_waiting_, num_waiting);
  if (!is_new && now_s - last_said_s_ < kRemindEvery_s) return false;
  last_said_s_ = now_s;
  return true;
}

std::optional<std::size_t> Trouble::Clear() {
  if (text_.empty()) return std::nullopt;
  const std::size_t max_waiting = max_waiting_;
  *this = Trouble();
  return max_waiting;
}

}  // namespace plumb::ros_adapter
