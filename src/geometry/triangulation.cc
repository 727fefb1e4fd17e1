// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/geometry/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

// Below this the depth is a matter of rounding errors.
constexpr double kMinParallaxRad = 1e-6;

// A view of a point, in a frame parallel to the map's whose origin is near the cameras, so
// that large map coordinates cost no digits.
struct LocalView {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d center;
  Eigen::Vector2d xy;
};

struct NormalEquations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;  // Infinite if the point is behind a camera.
};

NormalEquations Linearize(const LocalView* views, int num_views, const Eigen::Vector3d& point) {
  NormalEquations equations;
  for (int i = 0; i < num_views; ++i) {
    const LocalView& view = views[i];
    const Eigen::Vector3d in_cam = view.rotation * (point - view.center);
    if (!(in_cam.z() > 0.0)) {
      equations.cost = std::numeric_limits<double>::infinity();
      return equations;
    }
    const Eigen::Vector2d projected = in_cam.head<2>() / in_cam.z();
    const Eigen::Vector2d error = projected - view.xy;
    const Eigen::Matrix<double, 2, 3> jacobian =
        (view.rotation.topRows<2>() - projected * view.rotation.row(2)) / in_cam.z();
    equations.hessian.noalias() += jacobian.transpose() * jacobian;
    equations.gradient.noalias() += jacobian.transpose() * error;
    equations.cost += error.squaredNorm();
  }
  return equations;
}

// Gauss-Newton with step halving on the squared normalised reprojection error.
// Nothing if the start is behind a camera.
std::optional<Eigen::Vector3d> Refine(const LocalView* views,
                                      int num_views,
                                      int max_iterations,
                                      Eigen::Vector3d point) {
  constexpr double kConverged = 1e-10;  // Relative to the distance from the first camera.
  NormalEquations current = Linearize(views, num_views, point);
  if (!std::isfinite(current.cost)) return std::nullopt;
  for (int i = 0; i < max_iterations; ++i) {
    Eigen::Vector3d step = -current.hessian.ldlt().solve(current.gradient);
    if (!step.allFinite()) break;
    const double tolerance = kConverged * (point - views[0].center).norm();
    bool improved = false;
    for (int halving = 0; halving < 10 && !improved; ++halving, step *= 0.5) {
      const NormalEquations next = Linearize(views, num_views, point + step);
      if (!(next.cost < current.cost)) continue;
      improved = true;
      point += step;
      current = next;
    }
    if (!improved || step.norm() < tolerance) break;
  }
  return point;
}

// Linear least squares of (row_1 - x row_3) X = 0 and (row_2 - y row_3) X = 0 with the last
// coordinate of X fixed at 1 (Hartley & Sturm, CVIU 68(2), 1997, "Linear-LS").
Eigen::Vector3d SolveLinear(const std::vector<LocalView>& views) {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const LocalView& view : views) {
    const Eigen::Matrix<double, 2, 3> rows =
        view.rotation.topRows<2>() - view.xy * view.rotation.row(2);
    hessian.noalias() += rows.transpose() * rows;
    right.noalias() += rows.transpose() * (rows * view.center);
  }
  return hessian.ldlt().solve(right);
}

// Whether the views fix the point's depth. Across the rays n views weigh n / depth^2, along
// them about (parallax / depth)^2: the ratio of eigenvalues is the squared parallax.
bool IsWellConditioned(const std::vector<LocalView>& views, const Eigen::Vector3d& point) {
  const NormalEquations equations = Linearize(views.data(), static_cast<int>(views.size()), point);
  const Eigen::Vector3d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(equations.hessian, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return eigenvalues[0] > kMinParallaxRad * kMinParallaxRad * eigenvalues[2];
}

}  // namespace

std::optional<Eigen::Vector3d> TriangulateTwoViews(const Rigid3& cam1_from_map,
                                                   const Rigid3& cam2_from_map,
                                                   const Eigen::Vector2d& xy1,
                                                   const Eigen::Vector2d& xy2) {
  // In cam1's frame turned like the map: centres 0 and c, unit rays f1 and f2. The start is
  // the inverse-depth weighted mid-point, and the test of the signs of its depths, of Lee &
  // Civera, Triangulation: Why Optimize?, BMVC 2019, eqs. (9) to (11).
  const Eigen::Vector3d center1 = cam1_from_map.TargetOriginInSource();
  const std::array<LocalView, 2> views = {
      LocalView{cam1_from_map.rotation.toRotationMatrix(), Eigen::Vector3d::Zero(), xy1},
      LocalView{cam2_from_map.rotation.toRotationMatrix(),
                cam2_from_map.TargetOriginInSource() - center1,
                xy2}};
  const Eigen::Vector3d& c = views[1].center;
  const Eigen::Vector3d f1 = (views[0].rotation.transpose() * xy1.homogeneous()).normalized();
  const Eigen::Vector3d f2 = (views[1].rotation.transpose() * xy2.homogeneous()).normalized();
  const double sine = f1.cross(f2).norm();
  if (!(sine > kMinParallaxRad)) return std::nullopt;
  const double weight1 = f1.cross(c).norm();
  const double weight2 = f2.cross(c).norm();
  if (!(weight1 + weight2 > 0.0)) return std::nullopt;
  const Eigen::Vector3d on_ray1 = weight2 / sine * f1;
  const Eigen::Vector3d on_ray2 = weight1 / sine * f2;
  const double gap2 = (on_ray1 - c - on_ray2).squaredNorm();
  if (gap2 >= (on_ray1 - c + on_ray2).squaredNorm() ||
      gap2 >= (-on_ray1 - c - on_ray2).squaredNorm() ||
      gap2 >= (-on_ray1 - c + on_ray2).squaredNorm()) {
    return std::nullopt;
  }
  const Eigen::Vector3d start = (weight1 * on_ray1 + weight2 * (c + on_ray2)) / (weight1 + weight2);
  const std::optional<Eigen::Vector3d> point = Refine(views.data(), 2, 2, start);
  if (!point) return std::nullopt;
  return *point + center1;
}

std::optional<Eigen::Vector3d> TriangulateViews(
    const std::vector<NormalizedObservation>& observations) {
  constexpr int kMaxIterations = 50;
  if (observations.size() < 2) return std::nullopt;
  const Eigen::Vector3d origin = observations[0].cam_from_map->TargetOriginInSource();
  std::vector<LocalView> views;
  views.reserve(observations.size());
  for (const NormalizedObservation& observation : observations) {
    views.push_back({observation.cam_from_map->rotation.toRotationMatrix(),
                     observation.cam_from_map->TargetOriginInSource() - origin,
                     observation.xy});
  }
  const Eigen::Vector3d start = SolveLinear(views);
  if (!start.allFinite()) return std::nullopt;
  const std::optional<Eigen::Vector3d> point =
      Refine(views.data(), static_cast<int>(views.size()), kMaxIterations, start);
  if (!point || !IsWellConditioned(views, *point)) return std::nullopt;
  return *point + origin;
}

double ParallaxAngle(const Eigen::Vector3d& center1,
                     const Eigen::Vector3d& center2,
                     const Eigen::Vector3d& point) {
  const Eigen::Vector3d ray1 = point - center1;
  const Eigen::Vector3d ray2 = point - center2;
  return std::atan2(ray1.cross(ray2).norm(), ray1.dot(ray2));
}

}  // namespace plumb
