// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/evaluation/wall_bend.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "plumbline/common/options.h"

namespace plumb {
namespace {

constexpr double kMmPerM = 1000.0;
constexpr std::size_t kMinCells = 4;       // A plane fits any three.
constexpr double kMaxUnevenness_m = 1e-4;  // Files with float32 coordinates are even to this.
// Standard error of a median over that of a mean, and sigma over MAD, of a normal distribution.
constexpr double kMedianOverMean = 1.2533;
constexpr double kSigmaOverMad = 1.4826;

// Precondition: not empty.
double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

// With the median height still in bend_mm.
WallCell MakeCell(const std::vector<WallPoint>& points) {
  WallCell cell;
  cell.num_points = static_cast<int>(points.size());
  std::vector<double> heights_m;
  for (const WallPoint& point : points) {
    cell.u_m += point.x() / static_cast<double>(points.size());
    cell.v_m += point.y() / static_cast<double>(points.size());
    heights_m.push_back(point.z());
  }
  const double median_m = Median(heights_m);
  for (double& height_m : heights_m) height_m = std::abs(height_m - median_m);
  cell.bend_mm = kMmPerM * median_m;
  cell.sigma_mm = kMmPerM * kMedianOverMean * kSigmaOverMad * Median(heights_m) /
                  std::sqrt(static_cast<double>(points.size()));
  return cell;
}

// Takes the best plane off the cells; false if they lie in a row.
bool SubtractPlane(std::vector<WallCell>* cells) {
  const auto num_cells = static_cast<Eigen::Index>(cells->size());
  Eigen::MatrixX3d place(num_cells, 3);
  Eigen::VectorXd height(num_cells);
  for (Eigen::Index i = 0; i < num_cells; ++i) {
    const WallCell& cell = (*cells)[static_cast<std::size_t>(i)];
    place.row(i) << cell.u_m, cell.v_m, 1.0;
    height[i] = cell.bend_mm;
  }
  const Eigen::RowVector3d center = place.colwise().mean();
  place.leftCols<2>().rowwise() -= center.head<2>();
  Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(place);
  solver.setThreshold(1e-6);
  if (solver.rank() < 3) return false;
  const Eigen::VectorXd bend = height - place * solver.solve(height);
  for (Eigen::Index i = 0; i < num_cells; ++i) {
    (*cells)[static_cast<std::size_t>(i)].bend_mm = bend[i];
  }
  return true;
}

void Summarise(WallBend* wall) {
  double lowest_mm = wall->cells.front().bend_mm;
  double highest_mm = lowest_mm;
  double sum_of_squares = 0.0;
  for (const WallCell& cell : wall->cells) {
    if (std::abs(cell.bend_mm) >= wall->max_mm) {
      wall->max_mm = std::abs(cell.bend_mm);
      wall->sigma_mm = cell.sigma_mm;
    }
    lowest_mm = std::min(lowest_mm, cell.bend_mm);
    highest_mm = std::max(highest_mm, cell.bend_mm);
    sum_of_squares += cell.bend_mm * cell.bend_mm;
    wall->num_points += cell.num_points;
  }
  wall->range_mm = highest_mm - lowest_mm;
  wall->rms_mm = std::sqrt(sum_of_squares / static_cast<double>(wall->cells.size()));
}

// (u, v, height) of a point.
struct WallFrame {
  Eigen::Matrix3d wall_from_world_rotation;
  Eigen::Vector3d origin_in_world;

  WallPoint operator*(const Eigen::Vector3d& point_in_world) const {
    return wall_from_world_rotation * (point_in_world - origin_in_world);
  }
};

WallFrame FrameOf(const TriangleMesh& truth) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d* origin = nullptr;
  for (std::size_t i = 0; i < truth.is_main_wall.size(); ++i) {
    if (!truth.is_main_wall[i]) continue;
    const auto& corner = truth.triangles[i];
    origin = &truth.vertices[corner[0]];
    normal += (truth.vertices[corner[1]] - *origin).cross(truth.vertices[corner[2]] - *origin);
  }
  if (origin == nullptr || normal.norm() == 0.0) {
    throw std::invalid_argument("the surface marks no face as main_wall");
  }
  normal.normalize();
  const Eigen::Vector3d up = std::abs(normal.z()) > 0.9 ? Eigen::Vector3d::UnitY().eval()
                                                        : Eigen::Vector3d::UnitZ().eval();
  const Eigen::Vector3d u_axis = up.cross(normal).normalized();
  Eigen::Matrix3d rotation;
  rotation << u_axis.transpose(), normal.cross(u_axis).transpose(), normal.transpose();
  return {rotation, *origin};
}

void CheckFlat(const TriangleMesh& truth, const WallFrame& frame) {
  for (std::size_t i = 0; i < truth.is_main_wall.size(); ++i) {
    if (!truth.is_main_wall[i]) continue;
    for (const std::uint32_t vertex : truth.triangles[i]) {
      if (std::abs((frame * truth.vertices[vertex]).z()) > kMaxUnevenness_m) {
        throw std::invalid_argument("the faces marked as main_wall do not lie in one plane");
      }
    }
  }
}

}  // namespace

std::vector<std::string> WallBendOptions::Problems() const {
  ProblemList problems;
  problems.Require(cell_m > 0.0, "cell_m", "positive", cell_m);
  problems.Require(min_points >= 1, "min_points", "at least 1", min_points);
  problems.Require(max_sigma_mm > 0.0, "max_sigma_mm", "positive", max_sigma_mm);
  problems.Require(max_distance_m > 0.0, "max_distance_m", "positive", max_distance_m);
  return problems.Take();
}

std::optional<WallBend> MeasureBend(const WallBendOptions& options,
                                    const std::vector<WallPoint>& points) {
  ThrowIfProblems("wall bend", options.Problems());
  std::map<std::pair<double, double>, std::vector<WallPoint>> points_of_cell;
  for (const WallPoint& point : points) {
    points_of_cell[{std::floor(point.x() / options.cell_m), std::floor(point.y() / options.cell_m)}]
        .push_back(point);
  }
  WallBend wall;
  for (const auto& [square, points_in_cell] : points_of_cell) {
    const WallCell cell = MakeCell(points_in_cell);
    if (cell.num_points < options.min_points || cell.sigma_mm > options.max_sigma_mm) {
      ++wall.num_left_out;
    } else {
      wall.cells.push_back(cell);
    }
  }
  if (wall.cells.size() < kMinCells || !SubtractPlane(&wall.cells)) return std::nullopt;
  Summarise(&wall);
  return wall;
}

std::vector<WallPoint> PointsOfMainWall(const WallBendOptions& options,
                                        const TriangleMesh& truth,
                                        const MeshIndex& index,
                                        const std::vector<Eigen::Vector3d>& points) {
  ThrowIfProblems("wall bend", options.Problems());
  const WallFrame frame = FrameOf(truth);
  CheckFlat(truth, frame);
  std::vector<WallPoint> wall_points;
  for (const Eigen::Vector3d& point : points) {
    const NearestOnMesh nearest = index.NearestTo(point);
    if (nearest.distance > options.max_distance_m) continue;
    if (truth.is_main_wall[nearest.triangle_idx]) wall_points.push_back(frame * point);
  }
  return wall_points;
}

}  // namespace plumb
