// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/two_view_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/pose_refinement.h"
#include "plumbline/geometry/relative_pose.h"
#include "plumbline/geometry/triangulation.h"

namespace plumb {
namespace {

double SquaredProjectionError(const Eigen::Vector3d& in_cam, const Eigen::Vector2d& xy) {
  if (!(in_cam.z() > 0.0)) return std::numeric_limits<double>::infinity();
  return (in_cam.head<2>() / in_cam.z() - xy).squaredNorm();
}

// The greater squared error of the two views for the best point, finite or infinitely far.
double SquaredMatchError(const Rigid3& cam2_from_cam1,
                         const Rigid3Matrix& matrix,
                         const NormalizedMatch& match) {
  const Eigen::Vector3d ray1 = match.xy1.homogeneous();
  const double at_infinity = SquaredProjectionError(matrix.rotation * ray1, match.xy2);
  const auto point = TriangulateTwoViews(Rigid3(), cam2_from_cam1, match.xy1, match.xy2);
  if (!point) return at_infinity;
  const double error1 = SquaredProjectionError(*point, match.xy1);
  const double error2 =
      SquaredProjectionError(matrix.rotation * *point + matrix.translation, match.xy2);
  return std::min(at_infinity, std::max(error1, error2));
}

}  // namespace

TwoViewSupport SupportOf(const Rigid3& cam2_from_cam1,
                         const std::vector<NormalizedMatch>& matches,
                         double max_error) {
  const Eigen::Matrix3d essential = EssentialFromPose(cam2_from_cam1);
  const Rigid3Matrix matrix(cam2_from_cam1);
  const double max_error2 = max_error * max_error;
  TwoViewSupport support;
  support.is_inlier.reserve(matches.size());
  for (const NormalizedMatch& match : matches) {
    // Errors below max_error in both views leave a Sampson error below sqrt(2) max_error.
    constexpr double kHopeless = 4.0;
    double error2 = std::numeric_limits<double>::infinity();
    if (SquaredSampsonError(essential, match.xy1, match.xy2) < kHopeless * max_error2) {
      error2 = SquaredMatchError(cam2_from_cam1, matrix, match);
    }
    const bool is_inlier = error2 < max_error2;
    support.is_inlier.push_back(is_inlier ? 1 : 0);
    support.num_inliers += is_inlier ? 1 : 0;
    support.cost += is_inlier ? error2 / max_error2 : 1.0;
  }
  return support;
}

double MedianParallax(const Rigid3& cam2_from_cam1,
                      const std::vector<NormalizedMatch>& matches,
                      const std::vector<char>& is_inlier) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!is_inlier[i]) continue;
    const Eigen::Vector3d ray1 = cam2_from_cam1.rotation * matches[i].xy1.homogeneous();
    const Eigen::Vector3d ray2 = matches[i].xy2.homogeneous();
    angles.push_back(std::atan2(ray1.cross(ray2).norm(), ray1.dot(ray2)));
  }
  if (angles.empty()) return 0.0;
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

}  // namespace plumb
