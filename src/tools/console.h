// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

#include "plumbline/map/photo_verdict.h"

namespace plumb::tools {

// One line: name, verdict, reason and hint, what agrees and its median error, seconds.
std::string Describe(const PhotoVerdict& verdict);

// Lines, and on a terminal a progress bar below them.
class Console {
 public:
  // `out` must outlive this.
  Console(std::ostream* out, bool is_terminal) : out_(out), is_terminal_(is_terminal) {}
  ~Console() { ClearBar(); }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool is_terminal() const { return is_terminal_; }

  void PrintLine(const std::string& line);

  // `num_done` of `num_all` photos, and what stands behind the bar.
  void ShowProgress(std::size_t num_done, std::size_t num_all, const std::string& note);

 private:
  void ClearBar();

  std::ostream* out_;
  bool is_terminal_;
  std::string bar_;
};

}  // namespace plumb::tools
