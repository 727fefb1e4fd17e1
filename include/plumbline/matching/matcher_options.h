// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

struct MatcherOptions {
  // A match must be nearer than this times the second nearest candidate, as distances (not
  // squared). Stricter than Lowe's 0.8 (IJCV 2004, section 7.1), for windows and stones repeat: it
  // took the mean error of Herz-Jesus-P8 over five orders from 3.4-3.7 mm to 3.1-3.4 mm.
  double max_ratio = 0.7;

  // A photo that the matches within max_ratio do not place is tried with those within this, and a
  // view of few landmarks is expanded with them: it was taken far from all others, and few of its
  // features look as they did.
  double max_wide_ratio = 0.85;

  // Threads of one call; the matches do not depend on it. One, because the callers already
  // match several photos side by side.
  int num_threads = 1;

  // One message per violated bound; empty if the options are usable.
  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(MatcherOptions& options, Visitor&& visit) {
  visit("max_ratio", options.max_ratio);
  visit("max_wide_ratio", options.max_wide_ratio);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
