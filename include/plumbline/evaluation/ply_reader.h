// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plumbline/evaluation/triangle_mesh.h"

namespace plumb {

// PLY files, ascii or binary little-endian, with coordinates x, y, z of any numeric type; what
// else they hold is skipped. All throw std::runtime_error naming the file, what is wrong with it
// and the cure: no PLY, cut short, a number that is none or not finite, an index out of range.

// Faces are the list vertex_indices or vertex_index; one with more than three corners is taken
// as a fan. A face property main_wall, not 0, marks the truly flat wall.
TriangleMesh ReadPlyMesh(const std::string& path);

// The comments of the header, e.g. "frame: map".
std::vector<std::string> ReadPlyComments(const std::string& path);

// The vertices; faces, if any, are ignored.
std::vector<Eigen::Vector3d> ReadPlyPoints(const std::string& path);

}  // namespace plumb
