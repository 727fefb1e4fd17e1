// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/common/options.h"

namespace plumb {

struct BundleOptions {
  // Width of the Huber norm [px of the finest features]: residuals beyond it count
  // linearly. About four times the scatter of the residuals.
  double huber_width_px = 2.0;

  // Scatter of the features' weighted residuals [px of the finest features]. It puts them on one
  // scale with markers and measured positions, whose standard deviations are known.
  double feature_sigma_px = 0.5;

  // Multi-scale term of global bundles: residuals of a photo count by the distance of its scene,
  // over the median distance, to this power. 0: all photos alike. 1: as a wall takes the square of
  // that many more photos from nearer, rows at all distances have an equal say in it.
  double distance_exponent = 0.0;

  // After a photo: it and this many of the views that share most landmarks with it move.
  int num_local_views = 6;

  // At most this many landmarks enter a local bundle, those with the longest tracks first.
  int max_local_landmarks = 3000;

  // Steps of Levenberg-Marquardt of a local bundle at most; most converge in fewer.
  int max_local_iterations = 8;

  // Steps of Levenberg-Marquardt of a global bundle at most; most converge in fewer.
  int max_global_iterations = 20;

  // Stop when an iteration lowers the cost by less than this fraction. A thousand times less
  // moves the cameras of the shared scenes by about 0.1 mm in the mean error.
  double function_tolerance = 1e-4;

  // How far the first step may go, as Ceres counts it (Levenberg-Marquardt's damping is one over
  // it). A map that is nearly solved takes whole Gauss-Newton steps: only they settle soon what the
  // photos hardly determine, focal length and bend.
  double initial_trust_radius = 1e4;

  // A global bundle starts when the number of views has grown by this factor
  // since the last one: its cost per photo then stays bounded.
  double global_growth_ratio = 1.25;

  // Offline, a background bundle is taken in this many photos after its start.
  int global_latency_photos = 2;

  // Global bundles refine the focal lengths fx and fy that all photos share, or hold them as
  // calibrated.
  bool refine_focal_length = false;

  // Global bundles refine the principal point cx, cy, or hold it as calibrated.
  bool refine_principal_point = false;

  // Global bundles refine the distortion k1 to k3, p1 and p2, or hold it as calibrated.
  bool refine_distortion = false;

  // More threads than one make a solve depend on timing in its last digits.
  int num_threads = 1;

  std::vector<std::string> Problems() const;
};

template <typename Visitor>
void VisitFields(BundleOptions& options, Visitor&& visit) {
  visit("huber_width_px", options.huber_width_px);
  visit("feature_sigma_px", options.feature_sigma_px);
  visit("distance_exponent", options.distance_exponent);
  visit("num_local_views", options.num_local_views);
  visit("max_local_landmarks", options.max_local_landmarks);
  visit("max_local_iterations", options.max_local_iterations);
  visit("max_global_iterations", options.max_global_iterations);
  visit("function_tolerance", options.function_tolerance);
  visit("initial_trust_radius", options.initial_trust_radius);
  visit("global_growth_ratio", options.global_growth_ratio);
  visit("global_latency_photos", options.global_latency_photos);
  visit("refine_focal_length", options.refine_focal_length);
  visit("refine_principal_point", options.refine_principal_point);
  visit("refine_distortion", options.refine_distortion);
  visit("num_threads", options.num_threads);
}

}  // namespace plumb
