// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "geometry/cubic.h"
#include "plumbline/geometry/absolute_pose.h"

// The distances d = (d1, d2, d3) of the points from the camera obey
//   d^T M12 d = a12,  d^T M13 d = a13,  d^T M23 d = a23,
// with a_ij the squared side and d^T M_ij d = d_i^2 + d_j^2 - 2 b_ij d_i d_j, b_ij the cosine
// between rays. Two homogeneous combinations are conics through the same four points
// (d1 : d2 : d3). As Persson & Nordberg (Lambda Twist, ECCV 2018) and Ding et al. (Revisiting
// the P3P Problem, CVPR 2023), take the degenerate conic of their pencil, a pair of lines, from
// a root of a cubic; split it by its adjugate (Richter-Gebert, Perspectives on Projective
// Geometry, ch. 11.1); meet each line with another conic of the pencil.
namespace plumb {
namespace {

struct Triangle {
  std::array<Eigen::Matrix3d, 3> conics;  // M12, M13, M23.
  Eigen::Vector3d sides2;                 // a12, a13, a23.
};

Eigen::Matrix3d SideConic(const std::array<Eigen::Vector3d, 3>& rays, int i, int j) {
  Eigen::Matrix3d conic = Eigen::Matrix3d::Zero();
  conic(i, i) = conic(j, j) = 1.0;
  conic(i, j) = conic(j, i) = -rays[i].dot(rays[j]);
  return conic;
}

Eigen::Matrix3d Adjugate(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d adjugate;
  adjugate.row(0) = m.col(1).cross(m.col(2));
  adjugate.row(1) = m.col(2).cross(m.col(0));
  adjugate.row(2) = m.col(0).cross(m.col(1));
  return adjugate;
}

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

// Splits a symmetric matrix of rank 2 into l m^T + m l^T. Nothing if the lines are complex.
std::optional<std::array<Eigen::Vector3d, 2>> SplitIntoLines(const Eigen::Matrix3d& conic) {
  // adj(l m^T + m l^T) = -(l x m)(l x m)^T.
  const Eigen::Matrix3d adjugate = Adjugate(conic);
  int i = 0;
  adjugate.diagonal().cwiseAbs().maxCoeff(&i);
  if (!(adjugate(i, i) < 0.0)) return std::nullopt;
  const Eigen::Vector3d cross = adjugate.col(i) / std::sqrt(-adjugate(i, i));
  const Eigen::Matrix3d product = conic + CrossMatrix(cross);  // 2 m l^T or 2 l m^T.
  int row = 0;
  int col = 0;
  product.cwiseAbs().maxCoeff(&row, &col);
  return std::array<Eigen::Vector3d, 2>{product.row(row).transpose().normalized(),
                                        product.col(col).normalized()};
}

// Newton's method on the three equations of the sides, to rounding. False where it fails.
bool PolishDistances(const Triangle& triangle, Eigen::Vector3d* distances) {
  constexpr int kMaxIterations = 6;
  const double tolerance = 1e-15 * triangle.sides2.sum();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Eigen::Matrix3d jacobian;
    Eigen::Vector3d error;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d half_gradient = triangle.conics[k] * *distances;
      jacobian.row(k) = 2.0 * half_gradient.transpose();
      error[k] = distances->dot(half_gradient) - triangle.sides2[k];
    }
    if (error.cwiseAbs().maxCoeff() <= tolerance) break;
    const Eigen::Vector3d step = jacobian.inverse() * error;
    if (!step.allFinite()) break;  // A double root: as good as it gets.
    *distances -= step;
  }
  for (int k = 0; k < 3; ++k) {
    const double side2 = distances->dot(triangle.conics[k] * *distances);
    if (!(std::abs(side2 - triangle.sides2[k]) < 1e-6 * triangle.sides2.sum())) return false;
  }
  return distances->minCoeff() > 0.0;
}

// Appends the distances on the line l . d = 0 that lie on `conic`.
void MeetLine(const Triangle& triangle,
              const Eigen::Vector3d& line,
              const Eigen::Matrix3d& conic,
              std::vector<Eigen::Vector3d>* solutions) {
  // d = s u + t v for a basis u, v of the line.
  const Eigen::Vector3d u = line.unitOrthogonal();
  const Eigen::Vector3d v = line.cross(u);
  const double uu = u.dot(conic * u);
  const double uv = u.dot(conic * v);
  const double vv = v.dot(conic * v);
  const double discriminant = uv * uv - uu * vv;
  // A tangent line is a double solution, which rounding may push to either side of zero.
  if (discriminant < -1e-12 * (uu * uu + uv * uv + vv * vv)) return;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double sum = -(uv + std::copysign(root, uv));
  const Eigen::Matrix3d perimeter = triangle.conics[0] + triangle.conics[1] + triangle.conics[2];
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(sum * u + uu * v), Eigen::Vector3d(vv * u + sum * v)}) {
    const double norm2 = direction.dot(perimeter * direction);
    if (!(norm2 > 0.0)) continue;
    Eigen::Vector3d distances = std::sqrt(triangle.sides2.sum() / norm2) * direction;
    if (distances.sum() < 0.0) distances = -distances;
    if (distances.minCoeff() > 0.0 && PolishDistances(triangle, &distances)) {
      solutions->push_back(distances);
    }
  }
}

std::vector<Eigen::Vector3d> SolveDistances(const Triangle& triangle) {
  const Eigen::Vector3d& a = triangle.sides2;
  const auto& m = triangle.conics;
  const Eigen::Matrix3d first = (a[2] * m[0] - a[0] * m[2]) / (a[2] + a[0]);
  const Eigen::Matrix3d second = (a[2] * m[1] - a[1] * m[2]) / (a[2] + a[1]);
  // det(first + g second) = 0.
  const Eigen::Matrix3d first_adjugate = Adjugate(first);
  const Eigen::Matrix3d second_adjugate = Adjugate(second);
  const std::optional<HomogeneousRoot> root =
      BestRealRoot({first.determinant(),
                    first_adjugate.cwiseProduct(second.transpose()).sum(),
                    second_adjugate.cwiseProduct(first.transpose()).sum(),
                    second.determinant()});
  std::vector<Eigen::Vector3d> solutions;
  if (!root) return solutions;
  const auto lines = SplitIntoLines(root->denominator * first + root->numerator * second);
  if (!lines) return solutions;
  // The member of the pencil farthest from the degenerate one.
  const Eigen::Matrix3d other = root->denominator * second - root->numerator * first;
  for (const Eigen::Vector3d& line : *lines) MeetLine(triangle, line, other, &solutions);
  return solutions;
}

// Orthonormal frame of a triangle: first side, in-plane normal, normal.
Eigen::Matrix3d FrameOf(const Eigen::Vector3d& p1,
                        const Eigen::Vector3d& p2,
                        const Eigen::Vector3d& p3) {
  Eigen::Matrix3d frame;
  frame.col(0) = (p2 - p1).normalized();
  frame.col(2) = (p2 - p1).cross(p3 - p1).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

}  // namespace

std::vector<Rigid3> SolveP3P(const std::array<Eigen::Vector3d, 3>& rays_in_cam,
                             const std::array<Eigen::Vector3d, 3>& points_in_map) {
  constexpr double kMinRelativeSine = 1e-7;
  const auto& p = points_in_map;
  const Eigen::Vector3d sides2(
      (p[0] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm(), (p[1] - p[2]).squaredNorm());
  const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  if (!(twice_area > kMinRelativeSine * sides2.maxCoeff())) return {};
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
    if (!(rays_in_cam[i].cross(rays_in_cam[j]).norm() > kMinRelativeSine)) return {};
  }
  const double scale2 = sides2.sum();
  const Triangle triangle = {
      {SideConic(rays_in_cam, 0, 1), SideConic(rays_in_cam, 0, 2), SideConic(rays_in_cam, 1, 2)},
      sides2 / scale2};
  const Eigen::Matrix3d map_frame = FrameOf(p[0], p[1], p[2]);
  std::vector<Rigid3> poses;
  for (const Eigen::Vector3d& relative : SolveDistances(triangle)) {
    const Eigen::Vector3d distances = std::sqrt(scale2) * relative;
    const Eigen::Vector3d first_in_cam = distances[0] * rays_in_cam[0];
    const Eigen::Matrix3d cam_frame =
        FrameOf(first_in_cam, distances[1] * rays_in_cam[1], distances[2] * rays_in_cam[2]);
    const Eigen::Quaterniond rotation(Eigen::Matrix3d(cam_frame * map_frame.transpose()));
    const Rigid3 rotated(rotation, Eigen::Vector3d::Zero());
    poses.emplace_back(rotation, first_in_cam - rotated * p[0]);
  }
  return poses;
}

}  // namespace plumb
