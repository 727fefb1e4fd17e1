// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/map/map_delta.h"

namespace plumb {

// Writes the landmarks as a binary little-endian PLY: x, y, z as doubles, since float32 loses
// centimetres in large coordinates, in the map's frame; red, green, blue. `comments` are lines of
// the header that say what the coordinates are. Replaces the file as a whole. Throws
// std::runtime_error naming the file and the cause.
void ExportPly(const std::vector<LandmarkState>& landmarks,
               const std::string& path,
               const std::vector<std::string>& comments = {"frame: map"});

}  // namespace plumb
