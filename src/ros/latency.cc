// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/latency.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "plumbline/common/check.h"

namespace plumb::ros_adapter {

double Latency::Quantile_s(double fraction) const {
  PLUMB_CHECK(!seconds_.empty());
  PLUMB_CHECK(fraction >= 0.0 && fraction <= 1.0);
  std::vector<double> sorted = seconds_;
  const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
  const auto nth = static_cast<std::ptrdiff_t>(std::max(1.0, rank)) - 1;
  std::nth_element(sorted.begin(), sorted.begin() + nth, sorted.end());
  return sorted[static_cast<std::size_t>(nth)];
}

}  // namespace plumb::ros_adapter
