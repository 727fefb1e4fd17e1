// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plumbline/geometry/rigid3.h"

namespace plumb {

struct TwoViewOptions {
  // Inlier bound on the reprojection error in either view, in normalised coordinates: pixels
  // by focal length.
  double max_error = 0.002;

  // Probability with which a sample free of outliers must have been drawn, for each of the
  // two models, before the search ends.
  double confidence = 0.9999;

  // Bound on the number of samples of each model.
  int max_iterations = 10000;

  // Equal input and seed give equal poses.
  int random_seed = 0;
};

struct TwoViewResult {
  enum class Model { kEssential, kHomography };

  Model model = Model::kEssential;  // That the pose was first derived from.
  Rigid3 cam2_from_cam1;            // |translation| = 1.

  // Per match: a point in front of both cameras, or at infinity, explains it.
  std::vector<char> is_inlier;
  int num_inliers = 0;

  // Median angle between the two rays of an inlier. Near max_error or below, the camera has
  // only turned and the translation means nothing.
  double median_parallax_rad = 0.0;

  int num_essential_inliers = 0;   // Of the best essential matrix, by Sampson error.
  int num_homography_inliers = 0;  // Of the best homography, by transfer error both ways.

  // A different pose explains nearly as many matches, as an exact plane allows, or the matches
  // leave the pose uncertain by more than 0.01 rad in rotation or 0.1 rad in direction (one sigma).
  bool is_ambiguous = false;
};

// Relative pose of two views of a general or planar scene from matches of observations
// (X/Z, Y/Z), free of distortion, some of them wrong. An essential matrix and a homography are
// estimated robustly; of the poses they allow, the one that explains the most matches is
// refined and given. Nothing with fewer than eight inliers. Thread-safe.
// Preconditions: positive max_error, confidence within (0, 1), equal lengths.
std::optional<TwoViewResult> EstimateTwoView(const TwoViewOptions& options,
                                             const std::vector<Eigen::Vector2d>& xy1,
                                             const std::vector<Eigen::Vector2d>& xy2);

// [t]x R: (xy2, 1)^T E (xy1, 1) = 0 for a point seen in both views.
Eigen::Matrix3d EssentialFromPose(const Rigid3& cam2_from_cam1);

// Distance of a match from the epipolar geometry, to first order, in normalised coordinates
// (Sampson's; Hartley & Zisserman, Multiple View Geometry, 2nd ed., eq. 11.9, its root).
double SampsonError(const Eigen::Matrix3d& essential,
                    const Eigen::Vector2d& xy1,
                    const Eigen::Vector2d& xy2);

}  // namespace plumb
