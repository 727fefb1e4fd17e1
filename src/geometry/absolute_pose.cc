// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/absolute_pose.h"

#include <limits>

#include "geometry/pose_refinement.h"
#include "geometry/ransac.h"
#include "plumbline/common/check.h"

namespace plumb {
namespace {

// Absolute pose as a problem of Ransac.
class PoseProblem {
 public:
  using Model = Rigid3Matrix;
  static constexpr int kSampleSize = 3;

  PoseProblem(const std::vector<Eigen::Vector2d>& xy,
              const std::vector<Eigen::Vector3d>& points_in_map,
              double max_error)
      : xy_(xy), points_in_map_(points_in_map), max_error_(max_error) {}

  int size() const { return static_cast<int>(xy_.size()); }

  void Solve(const std::array<int, 3>& sample, std::vector<Model>* models) const {
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto match = static_cast<std::size_t>(sample[i]);
      rays[i] = xy_[match].homogeneous().normalized();
      points[i] = points_in_map_[match];
    }
    for (const Rigid3& pose : SolveP3P(rays, points)) models->emplace_back(pose);
  }

  double SquaredError(const Model& model, int match) const {
    const auto i = static_cast<std::size_t>(match);
    const Eigen::Vector3d in_cam = model.rotation * points_in_map_[i] + model.translation;
    if (!(in_cam.z() > 0.0)) return std::numeric_limits<double>::infinity();
    const double inverse_depth = 1.0 / in_cam.z();
    const double dx = in_cam.x() * inverse_depth - xy_[i].x();
    const double dy = in_cam.y() * inverse_depth - xy_[i].y();
    return dx * dx + dy * dy;
  }

  Model Refine(const Model& model, const std::vector<int>& inliers) const {
    std::vector<PoseObservation> observations;
    observations.reserve(inliers.size());
    for (const int i : inliers) {
      const auto match = static_cast<std::size_t>(i);
      observations.push_back({xy_[match], points_in_map_[match], 1.0});
    }
    constexpr int kMaxIterations = 10;
    return Model(
        MinimizeReprojectionError(model.ToRigid3(), observations, max_error_, kMaxIterations));
  }

 private:
  const std::vector<Eigen::Vector2d>& xy_;
  const std::vector<Eigen::Vector3d>& points_in_map_;
  double max_error_;
};

}  // namespace

std::optional<AbsolutePoseResult> EstimateAbsolutePose(
    const AbsolutePoseOptions& options,
    const std::vector<Eigen::Vector2d>& xy,
    const std::vector<Eigen::Vector3d>& points_in_map) {
  constexpr int kMinInliers = 4;  // Three fit any of P3P's solutions.
  PLUMB_CHECK_EQ(xy.size(), points_in_map.size());
  PLUMB_CHECK_GT(options.max_error, 0.0);
  PLUMB_CHECK_GT(options.confidence, 0.0);
  PLUMB_CHECK_LT(options.confidence, 1.0);
  const PoseProblem problem(xy, points_in_map, options.max_error);
  Ransac<PoseProblem> ransac({options.max_error,
                              options.confidence,
                              options.min_iterations,
                              options.max_iterations,
                              options.random_seed},
                             problem);
  const auto best = ransac.Run();
  if (!best || best->num_inliers < kMinInliers) return std::nullopt;
  AbsolutePoseResult result;
  result.cam_from_map = best->model.ToRigid3();
  result.is_inlier = ransac.InlierMask(best->model);
  result.num_inliers = best->num_inliers;
  result.num_iterations = best->num_iterations;
  return result;
}

Rigid3 RefineAbsolutePose(const Rigid3& initial,
                          const std::vector<Eigen::Vector2d>& xy,
                          const std::vector<Eigen::Vector3d>& points_in_map,
                          const std::vector<char>& is_inlier,
                          double huber_width,
                          const std::vector<double>& weights) {
  constexpr int kMaxIterations = 50;
  PLUMB_CHECK_EQ(xy.size(), points_in_map.size());
  PLUMB_CHECK_EQ(xy.size(), is_inlier.size());
  PLUMB_CHECK_GT(huber_width, 0.0);
  if (!weights.empty()) PLUMB_CHECK_EQ(xy.size(), weights.size());
  std::vector<PoseObservation> observations;
  for (std::size_t i = 0; i < xy.size(); ++i) {
    if (!is_inlier[i] || !((initial * points_in_map[i]).z() > 0.0)) continue;
    observations.push_back({xy[i], points_in_map[i], weights.empty() ? 1.0 : weights[i]});
  }
  return MinimizeReprojectionError(initial, observations, huber_width, kMaxIterations);
}

}  // namespace plumb
