// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/localizer_options.h"

namespace plumb {

std::vector<std::string> LocalizerOptions::Problems() const {
  ProblemList list;
  list.Require(num_views >= 1, "num_views", "at least 1", num_views);
  list.Require(max_error_px > 0.0, "max_error_px", "greater than 0", max_error_px);
  list.Require(
      max_refined_error_px > 0.0, "max_refined_error_px", "greater than 0", max_refined_error_px);
  list.Require(min_num_matches >= 4, "min_num_matches", "at least 4", min_num_matches);
  list.Require(min_num_inliers >= 4, "min_num_inliers", "at least 4", min_num_inliers);
  list.Require(min_num_related_inliers >= 4 && min_num_related_inliers <= min_num_inliers,
               "min_num_related_inliers",
               "from 4 to min_num_inliers",
               min_num_related_inliers);
  list.Require(
      min_num_cells >= 1 && min_num_cells <= 64, "min_num_cells", "from 1 to 64", min_num_cells);
  list.Require(max_second_pose_ratio > 0.0 && max_second_pose_ratio <= 1.0,
               "max_second_pose_ratio",
               "in (0, 1]",
               max_second_pose_ratio);
  list.Require(
      same_pose_angle_deg > 0.0, "same_pose_angle_deg", "greater than 0", same_pose_angle_deg);
  list.Require(same_pose_distance_ratio > 0.0,
               "same_pose_distance_ratio",
               "greater than 0",
               same_pose_distance_ratio);
  list.Require(guided_radius_px > 0.0, "guided_radius_px", "greater than 0", guided_radius_px);
  list.Require(confidence > 0.0 && confidence < 1.0, "confidence", "in (0, 1)", confidence);
  list.Require(min_iterations >= 1, "min_iterations", "at least 1", min_iterations);
  list.Require(max_iterations >= min_iterations,
               "max_iterations",
               "at least min_iterations",
               max_iterations);
  return list.Take();
}

}  // namespace plumb
