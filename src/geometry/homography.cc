// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/homography.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace plumb {
namespace {

// Columns that map the standard projective basis to four points; nothing if three of them lie
// on a line. `orientation` tells on which side of the others each point lies.
struct ProjectiveBasis {
  Eigen::Matrix3d columns;
  Eigen::Vector3d orientation;
};

std::optional<ProjectiveBasis> BasisOf(const std::array<Eigen::Vector2d, 4>& xy) {
  constexpr double kMinTwiceArea = 1e-8;
  Eigen::Matrix3d points;
  for (int i = 0; i < 3; ++i) points.col(i) = xy[i].homogeneous();
  const double determinant = points.determinant();
  if (!(std::abs(determinant) > kMinTwiceArea)) return std::nullopt;
  const Eigen::Vector3d scales = points.inverse() * xy[3].homogeneous();
  if (!((scales * determinant).cwiseAbs().minCoeff() > kMinTwiceArea)) return std::nullopt;
  return ProjectiveBasis{points * scales.asDiagonal(), scales};
}

}  // namespace

std::optional<Eigen::Matrix3d> SolveHomography(const std::array<NormalizedMatch, 4>& matches) {
  std::array<Eigen::Vector2d, 4> xy1;
  std::array<Eigen::Vector2d, 4> xy2;
  for (std::size_t i = 0; i < 4; ++i) {
    xy1[i] = matches[i].xy1;
    xy2[i] = matches[i].xy2;
  }
  const auto basis1 = BasisOf(xy1);
  const auto basis2 = BasisOf(xy2);
  if (!basis1 || !basis2) return std::nullopt;
  // H scales the i-th point by the ratio of the i-th scales: of one sign where all four are
  // in front of both cameras.
  const Eigen::Vector3d ratios = basis2->orientation.cwiseQuotient(basis1->orientation);
  if (ratios.minCoeff() <= 0.0 && ratios.maxCoeff() >= 0.0) return std::nullopt;
  const Eigen::Matrix3d h = basis2->columns * basis1->columns.inverse();
  return h / h.norm();
}

Eigen::Matrix3d RefineHomography(const Eigen::Matrix3d& initial,
                                 const std::vector<NormalizedMatch>& matches) {
  constexpr int kIterations = 3;
  if (matches.size() < 4) return initial;
  Eigen::Matrix3d h = initial;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Rows of the direct linear transform, divided by the point's depth under the last H.
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    for (const NormalizedMatch& match : matches) {
      const Eigen::Vector3d x1 = match.xy1.homogeneous();
      const Eigen::Vector3d weighted = x1 / h.row(2).dot(x1);
      Eigen::Matrix<double, 9, 2> rows = Eigen::Matrix<double, 9, 2>::Zero();
      for (int k = 0; k < 2; ++k) {
        rows.col(k).segment<3>(3 * k) = weighted;
        rows.col(k).tail<3>() = -match.xy2[k] * weighted;
      }
      normal.noalias() += rows * rows.transpose();
    }
    if (!normal.allFinite()) return h;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
    const Eigen::Matrix<double, 9, 1> entries = solver.eigenvectors().col(0);
    h = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(entries.data());
  }
  return h;
}

std::vector<Rigid3> PosesFromHomography(const Eigen::Matrix3d& h) {
  // Both cameras on one side of the plane: det > 0 (Malis & Vargas, INRIA RR-6303, 2007).
  const Eigen::Matrix3d oriented = h.determinant() < 0.0 ? Eigen::Matrix3d(-h) : h;
  cv::Mat homography;
  cv::eigen2cv(oriented, homography);
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  std::vector<cv::Mat> normals;
  cv::decomposeHomographyMat(
      homography, cv::Mat::eye(3, 3, CV_64F), rotations, translations, normals);
  std::vector<Rigid3> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    cv::cv2eigen(rotations[i], rotation);
    cv::cv2eigen(translations[i], translation);
    const double length = translation.norm();
    if (!rotation.allFinite() || !std::isfinite(length)) continue;
    const Eigen::Vector3d direction =
        length > 0.0 ? Eigen::Vector3d(translation / length) : Eigen::Vector3d::UnitX();
    poses.emplace_back(Eigen::Quaterniond(rotation), direction);
  }
  return poses;
}

}  // namespace plumb
