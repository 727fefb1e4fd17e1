// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace plumb::ros_adapter {

// Seconds from photo to verdict over a flight. Not thread-safe.
class Latency {
 public:
  void Add(double seconds) { seconds_.push_back(seconds); }

  bool IsEmpty() const { return seconds_.empty(); }
  double Last_s() const { return seconds_.back(); }

  // The smallest value that at least `fraction` (0 to 1) of all do not exceed (nearest rank).
  // There must be one.
  double Quantile_s(double fraction) const;

 private:
  std::vector<double> seconds_;
};

}  // namespace plumb::ros_adapter
