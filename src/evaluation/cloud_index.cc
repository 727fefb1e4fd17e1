// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>
#include <stdexcept>

#include "plumbline/evaluation/nearest.h"

namespace plumb {
namespace {

constexpr std::size_t kNumNeighbors = 8;
constexpr std::size_t kMinNeighbors = 4;  // Through three, every plane fits.

// The points as nanoflann wants to see them.
struct PointTable {
  std::vector<Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t idx, std::size_t axis) const {
    return points[idx][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // nanoflann finds it itself.
  }
};

PointTable MakeTable(std::vector<Eigen::Vector3d> points) {
  if (points.empty()) throw std::invalid_argument("the cloud has no point");
  return {std::move(points)};
}

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointTable>,
                                                 PointTable,
                                                 3,
                                                 std::uint32_t>;

}  // namespace

class CloudIndex::Impl {
 public:
  explicit Impl(std::vector<Eigen::Vector3d> points)
      : table_(MakeTable(std::move(points))), tree_(3, table_) {}

  double DistanceTo(const Eigen::Vector3d& point) const {
    std::uint32_t idx = 0;
    double squared_distance = 0.0;
    tree_.knnSearch(point.data(), 1, &idx, &squared_distance);
    return std::sqrt(squared_distance);
  }

  double DistanceToSurface(const Eigen::Vector3d& point) const {
    std::array<std::uint32_t, kNumNeighbors> idx{};
    std::array<double, kNumNeighbors> squared_distance{};
    const std::size_t num_neighbors =
        tree_.knnSearch(point.data(), kNumNeighbors, idx.data(), squared_distance.data());
    const double nearest = std::sqrt(squared_distance[0]);
    if (num_neighbors < kMinNeighbors) return nearest;

    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kNumNeighbors> neighbors(3, num_neighbors);
    for (std::size_t i = 0; i < num_neighbors; ++i) {
      neighbors.col(static_cast<Eigen::Index>(i)) = table_.points[idx[i]];
    }
    const Eigen::Vector3d centroid = neighbors.rowwise().mean();
    neighbors.colwise() -= centroid;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
        Eigen::Matrix3d(neighbors * neighbors.transpose()));
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    const double height = normal.dot(point - centroid);
    const double foot_radius = (point - centroid - height * normal).norm();
    if (foot_radius > neighbors.colwise().norm().maxCoeff()) return nearest;
    return std::min(nearest, std::abs(height));
  }

 private:
  PointTable table_;
  Tree tree_;
};

CloudIndex::CloudIndex(std::vector<Eigen::Vector3d> points)
    : impl_(std::make_unique<Impl>(std::move(points))) {}
CloudIndex::~CloudIndex() = default;

double CloudIndex::DistanceTo(const Eigen::Vector3d& point) const {
  return impl_->DistanceTo(point);
}

double CloudIndex::DistanceToSurface(const Eigen::Vector3d& point) const {
  return impl_->DistanceToSurface(point);
}

}  // namespace plumb
