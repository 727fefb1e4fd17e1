// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/bundle_options.h"

namespace plumb {

std::vector<std::string> BundleOptions::Problems() const {
  ProblemList list;
  list.Require(huber_width_px > 0.0, "huber_width_px", "greater than 0", huber_width_px);
  list.Require(feature_sigma_px > 0.0, "feature_sigma_px", "greater than 0", feature_sigma_px);
  list.Require(distance_exponent >= 0.0 && distance_exponent <= 4.0,
               "distance_exponent",
               "from 0 to 4",
               distance_exponent);
  list.Require(num_local_views >= 1, "num_local_views", "at least 1", num_local_views);
  list.Require(
      max_local_landmarks >= 100, "max_local_landmarks", "at least 100", max_local_landmarks);
  list.Require(
      max_local_iterations >= 1, "max_local_iterations", "at least 1", max_local_iterations);
  list.Require(
      max_global_iterations >= 1, "max_global_iterations", "at least 1", max_global_iterations);
  list.Require(
      function_tolerance > 0.0, "function_tolerance", "greater than 0", function_tolerance);
  list.Require(
      initial_trust_radius > 0.0, "initial_trust_radius", "greater than 0", initial_trust_radius);
  list.Require(
      global_growth_ratio > 1.0, "global_growth_ratio", "greater than 1", global_growth_ratio);
  list.Require(
      global_latency_photos >= 0, "global_latency_photos", "at least 0", global_latency_photos);
  list.Require(num_threads >= 1, "num_threads", "at least 1", num_threads);
  return list.Take();
}

}  // namespace plumb
