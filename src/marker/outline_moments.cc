// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/outline_moments.h"

#include <cmath>
#include <cstdint>

namespace plumb {

OutlineMoments MomentsOf(const std::vector<cv::Point>& outline) {
  // Twice the area and its moments times 6, 12 and 24, all with the sign of the sense of rotation.
  std::int64_t area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  std::int64_t x0 = 0, y0 = 0;  // From the first point, for the numbers to stay small.
  for (const cv::Point& point : outline) {
    const std::int64_t x1 = point.x - outline.front().x;
    const std::int64_t y1 = point.y - outline.front().y;
    const std::int64_t cross = x0 * y1 - x1 * y0;
    area += cross;
    x += cross * (x0 + x1);
    y += cross * (y0 + y1);
    xx += cross * (x0 * x0 + x0 * x1 + x1 * x1);
    xy += cross * (x0 * (2 * y0 + y1) + x1 * (y0 + 2 * y1));
    yy += cross * (y0 * y0 + y0 * y1 + y1 * y1);
    x0 = x1;
    y0 = y1;
  }
  OutlineMoments moments;
  if (area == 0) return moments;
  const double twice_area = static_cast<double>(area);
  const Eigen::Vector2d centroid =
      Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y)) / (3.0 * twice_area);
  const double mean_xy = static_cast<double>(xy) / (12.0 * twice_area);
  moments.area_px2 = std::abs(twice_area) / 2.0;
  moments.centroid_px = Eigen::Vector2d(outline.front().x, outline.front().y) + centroid;
  moments.spread_px2 << static_cast<double>(xx) / (6.0 * twice_area), mean_xy, mean_xy,
      static_cast<double>(yy) / (6.0 * twice_area);
  moments.spread_px2 -= centroid * centroid.transpose();
  return moments;
}

}  // namespace plumb
