// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace plumb {

// Nanoseconds since the Unix epoch, UTC; of a photo: the middle of its exposure.
struct Timestamp {
  std::int64_t ns = 0;

  friend bool operator==(Timestamp a, Timestamp b) { return a.ns == b.ns; }
  friend bool operator<(Timestamp a, Timestamp b) { return a.ns < b.ns; }
};

}  // namespace plumb
