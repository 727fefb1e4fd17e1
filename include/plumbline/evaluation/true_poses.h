// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

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

}  // namespace plumb
