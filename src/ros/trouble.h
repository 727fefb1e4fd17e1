// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace plumb::ros_adapter {

// Something that keeps a node from its work and may last, such as a full disk: says when it is
// worth a line of the log. Times are seconds of any steady clock. Not thread-safe.
class Trouble {
 public:
  // It is there, and so many photos wait for its end. True if that is to be said: at the
  // beginning, then once a minute, whatever the text becomes.
  bool Set(const std::string& text, std::size_t num_waiting, double now_s);

  // It is over. The most photos that waited, if there was any trouble.
  std::optional<std::size_t> Clear();

  // Empty if there is none.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t max_waiting_ = 0;
  double last_said_s_ = 0.0;
};

}  // namespace plumb::ros_adapter
