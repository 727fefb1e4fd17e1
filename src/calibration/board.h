// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/camera/projection.h"
#include "plumbline/geometry/rigid3.h"
#include "plumbline/marker/ellipse.h"

namespace plumb {

// One marker in one photo.
struct MarkerView {
  int photo_idx = 0;   // Into BoardState::cams_from_plane.
  int marker_idx = 0;  // Into BoardState::centers_in_plane.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
  Ellipse ellipse;
  bool is_wrong = false;  // Does not count.
};

// What is to be reconstructed. Lengths in marker diameters.
struct Board {
  int width_px = 0;
  int height_px = 0;
  int num_photos = 0;
  int num_markers = 0;
  std::vector<MarkerView> views;         // By photo, then by marker.
  std::vector<Eigen::Vector2d> printed;  // Centres on a fixed grid, y up; empty if strewn.
};

// A reconstruction of it; the frame `plane` is that of calibration_result.h, its origin free.
struct BoardState {
  LensParameters<double> lens{};
  std::vector<Rigid3> cams_from_plane;
  std::vector<Eigen::Vector3d> centers_in_plane;
  double stretch = 1.0;  // Of a printed grid, along y over along x.
  double shear = 0.0;    // Of a printed grid, of x along y.
};

}  // namespace plumb
