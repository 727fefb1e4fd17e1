// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "plumbline/surface/mesh_delta.h"

namespace plumb {

// Of a face without area, as two landmarks in one place give, the normal is zero: nobody sees it.
struct FaceShape {
  Eigen::Vector3d center_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  // Outward, unit length.
  double area = 0.0;                                        // [map units^2]
};

// How well the photos show a face. A camera sees it if the face's centre is within its photo, the
// face is turned towards it, and no other face lies between. docs/quality.md has the formulas.
struct FaceQuality {
  // The longest stretch of the face that one pixel takes in, in the camera that has it shortest
  // [map units per px]; infinite if no camera sees the face.
  float gsd = std::numeric_limits<float>::infinity();

  // Standard deviation of a point in the middle of the face, in the direction where it is largest,
  // if all cameras that see it measure it with one pixel of noise [map units per px]; infinite if
  // their rays do not fix a point.
  float sigma_per_px = std::numeric_limits<float>::infinity();

  std::uint16_t num_views = 0;   // Cameras that see it.
  std::uint16_t num_hidden = 0;  // Cameras that would if nothing lay between.

  friend bool operator==(const FaceQuality& a, const FaceQuality& b) {
    return a.gsd == b.gsd && a.sigma_per_px == b.sigma_per_px && a.num_views == b.num_views &&
           a.num_hidden == b.num_hidden;
  }
  friend bool operator!=(const FaceQuality& a, const FaceQuality& b) { return !(a == b); }
};

// A block of the mesh; `shapes` and `qualities` are as long as its faces.
struct QualityBlock {
  MeshBlock mesh;
  std::vector<FaceShape> shapes;
  std::vector<FaceQuality> qualities;
};

std::vector<FaceShape> ShapesOf(const MeshBlock& block);

}  // namespace plumb
