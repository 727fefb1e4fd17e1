// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/simulation/world.h"

namespace plumb {

// Writes the true surface, plates included, as a binary little-endian PLY: x, y, z as doubles in
// the world's frame; triangles anticlockwise seen from outside, with a face property main_wall
// (1 on the wall that is truly flat). Replaces the file as a whole. Throws std::runtime_error
// naming the file, the cause and the cure.
void WriteSurfacePly(const World& world, const std::string& path);

}  // namespace plumb
