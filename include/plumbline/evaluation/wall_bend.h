// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "plumbline/evaluation/nearest.h"
#include "plumbline/evaluation/triangle_mesh.h"

namespace plumb {

// How the bend of a flat wall is told from the noise of its points.
struct WallBendOptions {
  // The wall is cut into squares of this side; a bend that is shorter is not seen.
  double cell_m = 2.0;

  // A square with fewer points says nothing.
  int min_points = 20;

  // Nor does one whose median is less certain than this (one sigma). Of some 200 squares the
  // worst is then off by 1.4 mm from noise alone, below the 2 mm that matter.
  double max_sigma_mm = 0.5;

  // Points of the wall lie within this distance of it.
  double max_distance_m = 0.3;

  std::vector<std::string> Problems() const;
};

// A square of the wall.
struct WallCell {
  double u_m = 0.0;  // Mean of its points, along the wall ...
  double v_m = 0.0;  // ... and up.
  int num_points = 0;
  double bend_mm = 0.0;   // Positive on the side that the wall faces.
  double sigma_mm = 0.0;  // Of bend_mm, from the spread of the points.
};

struct WallBend {
  double max_mm = 0.0;    // Largest |bend_mm|.
  double rms_mm = 0.0;    // Over the cells.
  double range_mm = 0.0;  // From the deepest to the highest.
  double sigma_mm = 0.0;  // Of the cell with the largest |bend_mm|.
  int num_points = 0;     // In the cells.
  int num_left_out = 0;   // Cells with points, but too few or too uncertain ones.
  std::vector<WallCell> cells;
};

// A point of the wall: u, v along the true wall's plane and the height above it [m].
using WallPoint = Eigen::Vector3d;

// The bend of a wall that is truly flat. Per cell the median height h of its n points, with sigma =
// 1.2533 * 1.4826 MAD / sqrt(n) (standard error of a median; MAD: median absolute deviation).
// The plane h = a u + b v + c fits the cells' medians best in least squares; what is left of a
// median is the cell's bend. So neither the noise of single points nor a tilt or an offset of
// the whole wall is called bend. Nothing if fewer than four cells are left or they lie in a row.
// Throws std::invalid_argument if options.Problems() is not empty.
std::optional<WallBend> MeasureBend(const WallBendOptions& options,
                                    const std::vector<WallPoint>& points);

// Those of `points` whose nearest triangle of `truth` is of the main wall. Throws
// std::invalid_argument if the mesh marks no main wall or its triangles are not in one plane.
// Precondition: `index` is of `truth`.
std::vector<WallPoint> PointsOfMainWall(const WallBendOptions& options,
                                        const TriangleMesh& truth,
                                        const MeshIndex& index,
                                        const std::vector<Eigen::Vector3d>& points);

}  // namespace plumb
