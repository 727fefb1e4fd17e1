// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <vector>

namespace plumb {

// Of the area within the polygon through the points of an outline, in its pixels.
struct OutlineMoments {
  double area_px2 = 0.0;
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();  // Undefined if there is no area.
  Eigen::Matrix2d spread_px2 = Eigen::Matrix2d::Zero();   // About the centroid, over the area.
};

// By Green's theorem (Steger, On the Calculation of Arbitrary Moments of Polygons, 1996), in
// integers: exact up to the last division if the outline is less than 10 000 pixels wide. What
// cv::moments gives, which takes longer to unwrap its argument than the outline of a speck does.
OutlineMoments MomentsOf(const std::vector<cv::Point>& outline);

}  // namespace plumb
