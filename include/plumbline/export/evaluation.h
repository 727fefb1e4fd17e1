// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "plumbline/geometry/similarity3.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

// Where a photo was truly taken.
struct TruePose {
  std::string photo;  // File name.
  Eigen::Quaterniond cam_from_world_rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d center_in_world_m = Eigen::Vector3d::Zero();
};

// Reads lines of photo,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m (Hamilton quaternion
// of cam_from_world, camera x right, y down, z forward). Blank lines, lines that begin with
// '#' and a header line are skipped. Throws std::runtime_error naming the file, and the
// number and fault of a bad line.
std::vector<TruePose> ReadTruePoses(const std::string& path);

struct PhotoError {
  std::string photo;
  double center_error_mm = 0.0;
  double rotation_error_deg = 0.0;
};

struct ErrorSummary {
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
};

struct Evaluation {
  int num_truth = 0;                // Photos with a true pose.
  int num_registered = 0;           // Those of them that the map has located.
  std::vector<std::string> missed;  // The others.
  Similarity3 world_from_map;       // Fits the camera centres best; its scale is metres a map unit.
  ErrorSummary center_error_mm;
  ErrorSummary rotation_error_deg;
  std::vector<PhotoError> photos;  // In the order of the truth.
};

// Aligns the map with the truth by the similarity that fits the camera centres best, and
// measures what is left. Photos are paired by name. Throws std::runtime_error if fewer than three
// photos are in both or their centres lie on a line, for the alignment is then not determined.
Evaluation EvaluatePoses(const std::vector<ViewState>& views, const std::vector<TruePose>& truth);

}  // namespace plumb
