// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/target_triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "plumbline/geometry/triangulation.h"

namespace plumb {
namespace {

// Enough for every pair of 18 photos; more add nothing but time.
constexpr std::size_t kMaxPairs = 150;

// A sighting with its ray. Errors are taken in the pixels of a camera without distortion.
struct Ray {
  int idx = 0;  // Of the sighting.
  const TargetSighting* sighting = nullptr;
  Eigen::Vector2d xy;
  Eigen::Matrix2d weight;  // [1/px^2]
};

class Triangulator {
 public:
  Triangulator(const TriangulationBounds& bounds, const Camera& camera)
      : bounds_(bounds), camera_(camera), focal_px_(camera.lens()[kFx], camera.lens()[kFy]) {}

  std::vector<Ray> RaysOf(const std::vector<TargetSighting>& sightings) const {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const auto xy = camera_.Unproject(sightings[i].pixel);
      if (!xy) continue;
      const Eigen::Matrix2d covariance =
          sightings[i].covariance_px2 +
          bounds_.min_sigma_px * bounds_.min_sigma_px * Eigen::Matrix2d::Identity();
      rays.push_back({static_cast<int>(i), &sightings[i], *xy, covariance.inverse()});
    }
    return rays;
  }

  std::optional<TriangulatedTarget> Triangulate(const std::vector<Ray>& rays) const {
    std::optional<Eigen::Vector3d> point = BestOfPairs(rays);
    // Twice: the refined point may reach other sightings.
    for (int i = 0; point && i < 2; ++i) point = Refine(Within(rays, *point), *point);
    if (!point) return std::nullopt;
    const std::vector<Ray> used = Within(rays, *point);
    if (used.size() < 2 || !HasParallax(used, *point)) return std::nullopt;
    TriangulatedTarget target;
    target.point_in_map = *point;
    for (const Ray& ray : used) target.used.push_back(ray.idx);
    Measure(used, &target);
    return target;
  }

  // Infinite behind the camera.
  double ErrorOf(const Ray& ray, const Eigen::Vector3d& point) const {
    const Eigen::Vector3d in_cam = ray.sighting->cam_from_map * point;
    if (!(in_cam.z() > 0.0)) return std::numeric_limits<double>::infinity();
    return (in_cam.hnormalized() - ray.xy).cwiseProduct(focal_px_).norm();
  }

 private:
  // Of each photo the sighting nearest to the point's image, if within the bound.
  std::vector<Ray> Within(const std::vector<Ray>& rays, const Eigen::Vector3d& point) const {
    std::map<PhotoId, Ray> nearest;
    for (const Ray& ray : rays) {
      const double error_px = ErrorOf(ray, point);
      if (error_px > bounds_.max_error_px) continue;
      const auto [entry, is_new] = nearest.insert({ray.sighting->photo, ray});
      if (!is_new && error_px < ErrorOf(entry->second, point)) entry->second = ray;
    }
    std::vector<Ray> within;
    for (const auto& [photo, ray] : nearest) within.push_back(ray);
    return within;
  }

  // Truncated: a photo that does not show the point there counts 1.
  double CostOf(const std::vector<Ray>& rays, const Eigen::Vector3d& point) const {
    std::map<PhotoId, double> cost_of_photo;
    for (const Ray& ray : rays) {
      const double relative = ErrorOf(ray, point) / bounds_.max_error_px;
      double& cost = cost_of_photo.insert({ray.sighting->photo, 1.0}).first->second;
      cost = std::min(cost, relative * relative);
    }
    double sum = 0.0;
    for (const auto& [photo, cost] : cost_of_photo) sum += cost;
    return sum;
  }

  std::optional<Eigen::Vector3d> BestOfPairs(const std::vector<Ray>& rays) const {
    const std::size_t num_pairs = rays.size() * (rays.size() - 1) / 2;
    const std::size_t step = 1 + (rays.empty() ? 0 : num_pairs / kMaxPairs);
    std::optional<Eigen::Vector3d> best;
    double best_cost = std::numeric_limits<double>::infinity();
    std::size_t pair = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (pair++ % step != 0 || rays[i].sighting->photo == rays[k].sighting->photo) continue;
        const auto point = TriangulateTwoViews(
            rays[i].sighting->cam_from_map, rays[k].sighting->cam_from_map, rays[i].xy, rays[k].xy);
        if (!point || !point->allFinite()) continue;
        const double cost = CostOf(rays, *point);
        if (!(cost < best_cost)) continue;
        best_cost = cost;
        best = point;
      }
    }
    return best;
  }

  // Of the error [px] by the point. The caller ensures that the point is before the camera.
  Eigen::Matrix<double, 2, 3> Jacobian(const Ray& ray, const Eigen::Vector3d& in_cam) const {
    const Eigen::Matrix3d rotation = ray.sighting->cam_from_map.rotation.toRotationMatrix();
    return focal_px_.asDiagonal() *
           (rotation.topRows<2>() - in_cam.hnormalized() * rotation.row(2)) / in_cam.z();
  }

  Eigen::Matrix3d Hessian(const std::vector<Ray>& rays,
                          const Eigen::Vector3d& point,
                          Eigen::Vector3d* gradient,
                          double* chi2) const {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (const Ray& ray : rays) {
      const Eigen::Vector3d in_cam = ray.sighting->cam_from_map * point;
      const Eigen::Vector2d error = (in_cam.hnormalized() - ray.xy).cwiseProduct(focal_px_);
      const Eigen::Matrix<double, 2, 3> jacobian = Jacobian(ray, in_cam);
      hessian += jacobian.transpose() * ray.weight * jacobian;
      *gradient += jacobian.transpose() * ray.weight * error;
      *chi2 += error.dot(ray.weight * error);
    }
    return hessian;
  }

  // Gauss-Newton; nothing if the sightings do not determine the point.
  std::optional<Eigen::Vector3d> Refine(const std::vector<Ray>& rays, Eigen::Vector3d point) const {
    constexpr int kMaxIterations = 20;
    if (rays.size() < 2) return std::nullopt;
    for (int i = 0; i < kMaxIterations; ++i) {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      double chi2 = 0.0;
      const Eigen::Matrix3d hessian = Hessian(rays, point, &gradient, &chi2);
      const Eigen::Vector3d step = -hessian.ldlt().solve(gradient);
      const Eigen::Vector3d next = point + step;
      for (const Ray& ray : rays) {
        if (!std::isfinite(ErrorOf(ray, next))) return std::nullopt;
      }
      point = next;
      const double distance = (rays[0].sighting->cam_from_map * point).norm();
      if (step.norm() < 1e-10 * distance) break;
    }
    return point;
  }

  bool HasParallax(const std::vector<Ray>& rays, const Eigen::Vector3d& point) const {
    const double bound_rad = bounds_.min_parallax_deg * M_PI / 180.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d center = rays[i].sighting->cam_from_map.TargetOriginInSource();
      for (std::size_t k = 0; k < i; ++k) {
        const Eigen::Vector3d other = rays[k].sighting->cam_from_map.TargetOriginInSource();
        if (ParallaxAngle(center, other, point) >= bound_rad) return true;
      }
    }
    return false;
  }

  void Measure(const std::vector<Ray>& rays, TriangulatedTarget* target) const {
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double chi2 = 0.0;
    const Eigen::Matrix3d hessian = Hessian(rays, target->point_in_map, &gradient, &chi2);
    const double freedom = 2.0 * static_cast<double>(rays.size()) - 3.0;
    target->covariance = hessian.inverse() * std::max(1.0, chi2 / freedom);
    double sum = 0.0;
    for (const Ray& ray : rays) sum += std::pow(ErrorOf(ray, target->point_in_map), 2);
    target->rms_error_px = std::sqrt(sum / static_cast<double>(rays.size()));
  }

  TriangulationBounds bounds_;
  const Camera& camera_;
  Eigen::Vector2d focal_px_;
};

// Another place that enough of the other sightings agree on, and that the first place's photos
// would show well apart: not merely a place that the poses disagree about.
std::optional<Eigen::Vector3d> SecondPlace(const Triangulator& triangulator,
                                           const TriangulationBounds& bounds,
                                           const std::vector<Ray>& rays,
                                           const TriangulatedTarget& first) {
  constexpr double kApart = 5.0;
  const std::set<int> used(first.used.begin(), first.used.end());
  std::vector<Ray> used_rays;
  std::vector<Ray> others;
  for (const Ray& ray : rays) (used.count(ray.idx) != 0 ? used_rays : others).push_back(ray);
  const auto second = triangulator.Triangulate(others);
  if (!second || 3 * second->used.size() < first.used.size()) return std::nullopt;
  for (const Ray& ray : used_rays) {
    if (triangulator.ErrorOf(ray, second->point_in_map) < kApart * bounds.max_error_px) {
      return std::nullopt;
    }
  }
  return second->point_in_map;
}

}  // namespace

std::optional<TriangulatedTarget> TriangulateTarget(const TriangulationBounds& bounds,
                                                    const Camera& camera,
                                                    const std::vector<TargetSighting>& sightings) {
  const Triangulator triangulator(bounds, camera);
  const std::vector<Ray> rays = triangulator.RaysOf(sightings);
  std::optional<TriangulatedTarget> target = triangulator.Triangulate(rays);
  if (target) target->second_point_in_map = SecondPlace(triangulator, bounds, rays, *target);
  return target;
}

}  // namespace plumb
