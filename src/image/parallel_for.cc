// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/parallel_for.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

namespace plumb {

void ParallelFor(int num_threads,
                 int count,
                 int part_size,
                 const std::function<void(int begin, int end)>& body) {
  const int num_parts = (count + part_size - 1) / part_size;
  const auto run_part = [&](int part) {
    body(part * part_size, std::min(count, (part + 1) * part_size));
  };
  if (num_threads == 1 || num_parts <= 1) {
    for (int part = 0; part < num_parts; ++part) run_part(part);
    return;
  }
  cv::parallel_for_(
      cv::Range(0, num_parts),
      [&](const cv::Range& range) {
        for (int part = range.start; part < range.end; ++part) run_part(part);
      },
      num_threads == 0 ? -1.0 : static_cast<double>(num_threads));
}

}  // namespace plumb
