// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

// Poses cam_from_map that put three points of the map, in front of the camera, on three unit
// rays; at most four. Empty if the points are collinear or two rays agree.
std::vector<Rigid3> SolveP3P(const std::array<Eigen::Vector3d, 3>& rays_in_cam,
                             const std::array<Eigen::Vector3d, 3>& points_in_map);

struct AbsolutePoseOptions {
  // Inlier bound on the reprojection error in normalised coordinates: pixels by focal length.
  double max_error = 0.002;

  // Probability with which a sample free of outliers must have been drawn before the search
  // ends; by the inliers found so far.
  double confidence = 0.9999;

  // Bounds on the number of samples. At 10 % inliers, 9206 samples reach the confidence.
  int min_iterations = 30;
  int max_iterations = 20000;

  // Equal input and seed give equal poses.
  int random_seed = 0;
};

struct AbsolutePoseResult {
  Rigid3 cam_from_map;
  std::vector<char> is_inlier;  // Per match.
  int num_inliers = 0;
  int num_iterations = 0;  // Samples drawn.
};

// Camera pose from matches of observations `xy` = (X/Z, Y/Z), free of distortion, with points of
// the map, some of them wrong: P3P in a locally optimised RANSAC that minimises the
// truncated squared reprojection error. Nothing if no pose has at least four inliers.
// Thread-safe. Preconditions: positive max_error, confidence within (0, 1), equal lengths.
std::optional<AbsolutePoseResult> EstimateAbsolutePose(
    const AbsolutePoseOptions& options,
    const std::vector<Eigen::Vector2d>& xy,
    const std::vector<Eigen::Vector3d>& points_in_map);

// cam_from_map that minimises the sum of weight * huber(reprojection error) of the inliers,
// from `initial` by Levenberg and Marquardt's method. `huber_width` is in normalised
// coordinates. Empty `weights` are all 1. Matches behind the initial camera are left out; with
// fewer than three in front of it, gives `initial`.
Rigid3 RefineAbsolutePose(const Rigid3& initial,
                          const std::vector<Eigen::Vector2d>& xy,
                          const std::vector<Eigen::Vector3d>& points_in_map,
                          const std::vector<char>& is_inlier,
                          double huber_width,
                          const std::vector<double>& weights = {});

}  // namespace plumb
