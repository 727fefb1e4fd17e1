// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct MatcherOptions {
  // A match must be nearer than this times the second nearest candidate, as distances (not
  // squared). Lowe (IJCV 2004, section 7.1) reads 0.8 off the densities of right and wrong
  // matches: it drops 90 % of the wrong ones and 5 % of the right ones.
  double max_ratio = 0.8;

  // Threads of one call; the matches do not depend on it. One, because the callers already
  // match several photos side by side.
  int num_threads = 1;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(MatcherOptions& options, Visitor&& visit) {
  visit("max_ratio", options.max_ratio);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
