// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/surface/mesh_delta.h"

namespace plumb {

// Both write a mesh snapshot as one mesh: a landmark that several blocks show is one vertex.
// Vertices ascend by landmark, with their colours; faces are anticlockwise seen from outside.
// `comments` are lines of the header that say what the coordinates are. The file is replaced as a
// whole. They throw std::runtime_error naming the file and the cause.

// Binary little-endian; x, y, z as doubles, since float32 loses centimetres in large coordinates.
void ExportMeshPly(const MeshDelta& snapshot,
                   const std::string& path,
                   const std::vector<std::string>& comments = {"frame: map"});

// Numbers read back to the last bit; colours follow the coordinates (v x y z r g b, 0 to 1), as
// MeshLab and Blender read them.
void ExportMeshObj(const MeshDelta& snapshot,
                   const std::string& path,
                   const std::vector<std::string>& comments = {"frame: map"});

}  // namespace plumb
