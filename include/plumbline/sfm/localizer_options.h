// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

struct LocalizerOptions {
  // A photo is matched with this many views, the most alike ones.
  int num_views = 8;

  // Inlier bound on the reprojection error while searching [px]. Wide: the map may
  // have drifted against the view it is matched with.
  double max_error_px = 8.0;

  // Inlier bound after refinement [px].
  double max_refined_error_px = 4.0;

  // With fewer matches the photo shows something else.
  int min_num_matches = 30;

  // With fewer inliers the pose is not believed.
  int min_num_inliers = 30;

  // With fewer inliers the photo shows something else: wrong matches agree by chance, up to 7 of
  // 94 between the sides of south_building.
  int min_num_related_inliers = 12;

  // Inliers must lie in this many cells of an 8 x 8 grid over the photo: a pose from
  // one corner is not measured in the others.
  int min_num_cells = 6;

  // A second, different pose that fits this fraction of the first one's inliers makes
  // the photo ambiguous.
  double max_second_pose_ratio = 0.5;

  // Poses are the same place if they differ by less than this angle, and are as near as below.
  double same_pose_angle_deg = 3.0;

  // Poses are the same place if their distance is less than this part of the median depth, and
  // their angle is as small as above.
  double same_pose_distance_ratio = 0.1;

  // Once a pose is known, landmarks are searched within this radius of where they must be [px].
  double guided_radius_px = 8.0;

  // RANSAC ends once a better pose would have been found with this confidence.
  double confidence = 0.9999;

  // RANSAC tries at least this many samples.
  int min_iterations = 50;

  // RANSAC tries at most this many samples, whatever its confidence.
  int max_iterations = 3000;

  // Seed of RANSAC: equal input and seed give equal poses.
  int random_seed = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(LocalizerOptions& options, Visitor&& visit) {
  visit("num_views", options.num_views);
  visit("max_error_px", options.max_error_px);
  visit("max_refined_error_px", options.max_refined_error_px);
  visit("min_num_matches", options.min_num_matches);
  visit("min_num_inliers", options.min_num_inliers);
  visit("min_num_related_inliers", options.min_num_related_inliers);
  visit("min_num_cells", options.min_num_cells);
  visit("max_second_pose_ratio", options.max_second_pose_ratio);
  visit("same_pose_angle_deg", options.same_pose_angle_deg);
  visit("same_pose_distance_ratio", options.same_pose_distance_ratio);
  visit("guided_radius_px", options.guided_radius_px);
  visit("confidence", options.confidence);
  visit("min_iterations", options.min_iterations);
  visit("max_iterations", options.max_iterations);
  visit("random_seed", options.random_seed);
}

}  // namespace plumb
