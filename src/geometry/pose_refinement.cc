// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/pose_refinement.h"

#include <Eigen/Geometry>
#include <limits>

#include "geometry/levenberg_marquardt.h"

namespace plumb {
namespace {

// Derivatives by (turn, shift) of the camera frame: point -> exp(turn) point + shift.
LinearizedCost<6> Linearize(const Rigid3Matrix& cam_from_map,
                            const std::vector<PoseObservation>& observations,
                            double huber_width) {
  LinearizedCost<6> result;
  for (const PoseObservation& observation : observations) {
    const Eigen::Vector3d in_cam =
        cam_from_map.rotation * observation.point_in_map + cam_from_map.translation;
    if (!(in_cam.z() > 0.0)) {
      result.cost = std::numeric_limits<double>::infinity();
      return result;
    }
    const double w = 1.0 / in_cam.z();
    const double x = in_cam.x() * w;
    const double y = in_cam.y() * w;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian << -x * y, 1.0 + x * x, -y, w, 0.0, -x * w,  //
        -1.0 - y * y, x * y, x, 0.0, w, -y * w;
    const Eigen::Vector2d error(x - observation.xy.x(), y - observation.xy.y());
    const HuberCost huber = Huber(error.squaredNorm(), huber_width);
    const double weight = observation.weight * huber.weight;
    result.hessian.noalias() += weight * jacobian.transpose() * jacobian;
    result.gradient.noalias() += weight * jacobian.transpose() * error;
    result.cost += observation.weight * huber.cost;
  }
  return result;
}

}  // namespace

Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

Rigid3 MinimizeReprojectionError(const Rigid3& initial,
                                 const std::vector<PoseObservation>& observations,
                                 double huber_width,
                                 int max_iterations) {
  if (observations.size() < 3) return initial;
  return MinimizeSquares<6>(
      initial,
      max_iterations,
      [&](const Rigid3& cam_from_map) {
        return Linearize(Rigid3Matrix(cam_from_map), observations, huber_width);
      },
      [](const Rigid3& cam_from_map, const Eigen::Matrix<double, 6, 1>& delta) {
        return Rigid3(RotationFromVector(delta.head<3>()), delta.tail<3>()) * cam_from_map;
      });
}

}  // namespace plumb
