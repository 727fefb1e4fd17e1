// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/map/map.h"
#include "plumbline/sfm/bundle_constraints.h"
#include "plumbline/sfm/bundle_options.h"

namespace plumb {

struct BundleView {
  PhotoId photo;
  Rigid3 cam_from_map;
  bool is_fixed = false;
};

struct BundleLandmark {
  LandmarkId id;
  Eigen::Vector3d position_in_map;
};

struct BundleObservation {
  std::uint32_t view_idx = 0;
  std::uint32_t landmark_idx = 0;
  Eigen::Vector2d pixel;  // Raw pixel.
  double weight = 1.0;    // Of the residual, before the Huber norm.
};

struct BundleMarker {
  int marker_id = -1;
  Eigen::Vector3d position_in_map;
  std::optional<MeasuredPosition> survey;
};

struct BundleSighting {
  std::uint32_t view_idx = 0;
  std::uint32_t marker_idx = 0;
  Eigen::Vector2d center_px;  // Raw pixel.
  double sigma_px = 0.0;
};

struct BundleCenter {
  std::uint32_t view_idx = 0;
  MeasuredPosition center;
};

// A self-contained copy of a part of the map: it can be solved in another thread
// while the map goes on.
struct BundleProblem {
  LensParameters<double> lens;
  std::vector<BundleView> views;
  std::vector<BundleLandmark> landmarks;
  std::vector<BundleObservation> observations;
  std::vector<BundleMarker> markers;
  std::vector<BundleSighting> sightings;
  std::vector<BundleCenter> centers;
};

struct BundleReport {
  bool is_usable = false;  // The problem holds a solution no worse than its start.
  int num_iterations = 0;
  double initial_cost = 0.0;  // Half the sum of the robust squared residuals [px^2].
  double final_cost = 0.0;
};

// Minimises the reprojection error in raw pixels under a Huber norm over all views
// that are not fixed, all landmarks and markers and, where the options say so, the shared lens
// (Ceres; Triggs et al., Bundle Adjustment - A Modern Synthesis, 2000). Markers and measured
// positions count by their standard deviations (options.feature_sigma_px is the features'), under
// the same norm. The gauge is held by fixed views, else by three measured positions, else by the
// first view's pose and one coordinate of the centre of the view farthest from it. Stops early and
// leaves the problem as it is when `cancel` becomes true.
BundleReport SolveBundle(const BundleOptions& options,
                         int max_iterations,
                         double function_tolerance,
                         const std::atomic<bool>* cancel,
                         BundleProblem* problem);

// The whole map, with the multi-scale term of options.distance_exponent (docs/bundle.md). Markers
// seen in fewer than two of the map's views and not surveyed are left out.
BundleProblem MakeGlobalBundle(const BundleOptions& options,
                               const Map& map,
                               const LensParameters<double>& lens,
                               const BundleConstraints& constraints = {});

// The surroundings of one view: the view and those that share most landmarks with it are free,
// the other views that see their landmarks are fixed.
BundleProblem MakeLocalBundle(const BundleOptions& options,
                              const Map& map,
                              const LensParameters<double>& lens,
                              PhotoId photo);

// Puts the solution of `problem`, made of `map` and unchanged since, into it.
void ApplyBundle(const BundleProblem& problem, Map* map);

// Puts the solution of a problem made of an earlier state into a map that has grown since.
// What came later moves with its surroundings: a view with the view it shares most
// landmarks with, a landmark with the views that see it.
void ApplyStaleBundle(const BundleProblem& before, const BundleProblem& after, Map* map);

}  // namespace plumb
