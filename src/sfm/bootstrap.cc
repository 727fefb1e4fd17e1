// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sfm/bootstrap.h"

#include <algorithm>
#include <cmath>

#include "plumbline/geometry/relative_pose.h"
#include "plumbline/geometry/triangulation.h"

namespace plumb {
namespace {

// Median depth in the first camera of the inliers, in units of the baseline.
std::optional<double> MedianDepth(const TwoViewResult& two_view,
                                  const std::vector<Eigen::Vector2d>& xy1,
                                  const std::vector<Eigen::Vector2d>& xy2) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < xy1.size(); ++i) {
    if (!two_view.is_inlier[i]) continue;
    const auto point = TriangulateTwoViews(Rigid3(), two_view.cam2_from_cam1, xy1[i], xy2[i]);
    if (point) depths.push_back(point->z());
  }
  if (depths.empty()) return std::nullopt;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

}  // namespace

PairAttempt TryInitialPair(const BootstrapOptions& options,
                           const Camera& camera,
                           const PhotoRecord& photo1,
                           const PhotoRecord& photo2,
                           const std::vector<FeatureMatch>& matches) {
  if (static_cast<int>(matches.size()) < options.min_num_inliers) {
    return {std::nullopt, RefusalReason::kNoOverlap};
  }
  std::vector<Eigen::Vector2d> xy1;
  std::vector<Eigen::Vector2d> xy2;
  for (const FeatureMatch& match : matches) {
    xy1.push_back(photo1.normalized[match.idx1]);
    xy2.push_back(photo2.normalized[match.idx2]);
  }
  TwoViewOptions two_view_options;
  two_view_options.max_error = options.max_error_px / camera.MeanFocalLength();
  two_view_options.max_iterations = options.max_iterations;
  two_view_options.random_seed = options.random_seed;
  const auto two_view = EstimateTwoView(two_view_options, xy1, xy2);
  if (!two_view || two_view->num_inliers < options.min_num_inliers) {
    return {std::nullopt, RefusalReason::kTooFewInliers};
  }
  const double parallax_deg = two_view->median_parallax_rad * 180.0 / M_PI;
  if (parallax_deg < options.min_parallax_deg) return {std::nullopt, RefusalReason::kNoParallax};
  if (two_view->is_ambiguous) return {std::nullopt, RefusalReason::kAmbiguous};
  const auto depth = MedianDepth(*two_view, xy1, xy2);
  if (!depth) return {std::nullopt, RefusalReason::kNoParallax};

  InitialPair pair{
      photo1.id, photo2.id, two_view->cam2_from_cam1, two_view->num_inliers, parallax_deg, 0.0};
  pair.cam2_from_cam1.translation *= kInitialMedianDepth / *depth;
  pair.score = pair.num_inliers * std::min(1.0, parallax_deg / options.good_parallax_deg);
  return {pair, RefusalReason::kNone};
}

Rigid3 FirstCameraFromMap() {
  Eigen::Matrix3d cam_from_map;  // x right, y down, z forward from x right, y forward, z up.
  cam_from_map << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  return {Eigen::Quaterniond(cam_from_map), Eigen::Vector3d::Zero()};
}

}  // namespace plumb
