// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "plumbline/geometry/similarity3.h"

namespace plumb {

// How a camera is turned.
struct CameraTurn {
  Eigen::Quaterniond cam_from_map;
  Eigen::Quaterniond cam_from_world;  // In truth.
};

// Centres that nearly lie on a line leave the turn about it to their errors. If none of them is
// farther than max_offset_m from the line that fits them best, the alignment is turned about that
// line by the median of what `turns` say; else it is given back as it is. Precondition: as many
// turns as centres, at least one.
Similarity3 TurnAboutLine(const Similarity3& world_from_map,
                          const std::vector<Eigen::Vector3d>& centers_in_world,
                          const std::vector<CameraTurn>& turns,
                          double max_offset_m);

}  // namespace plumb
