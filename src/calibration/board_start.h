// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "calibration/board.h"

namespace plumb {

// A first reconstruction for one focal length; the lens has no distortion and its principal point
// in the middle.
struct BoardStart {
  BoardState state;
  std::vector<char> has_pose;    // Of each photo; the others share no markers with them.
  std::vector<char> has_center;  // Of each marker.
};

// Lays the photos' planes, each told by the shapes of its markers, over one another by the markers
// they share, or over the printed grid. Nothing if no photo has a plane.
std::optional<BoardStart> StartBoard(const Board& board, double focal_px);

}  // namespace plumb
