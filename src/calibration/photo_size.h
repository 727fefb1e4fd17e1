// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "plumbline/calibration/calibration_photo.h"

namespace plumb {

// Width and height [px] that most photos have, the earlier one of equals; 0, 0 without any.
inline std::pair<int, int> UsualSize(const std::vector<CalibrationPhoto>& photos) {
  std::map<std::pair<int, int>, int> counts;
  for (const CalibrationPhoto& photo : photos) ++counts[{photo.width_px, photo.height_px}];
  std::pair<int, int> usual{0, 0};
  int most = 0;
  for (const CalibrationPhoto& photo : photos) {
    const std::pair<int, int> size{photo.width_px, photo.height_px};
    if (counts[size] <= most) continue;
    most = counts[size];
    usual = size;
  }
  return usual;
}

}  // namespace plumb
