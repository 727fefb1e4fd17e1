// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calibration/board_refinement.h"

namespace plumb {

// Where a marker lies that fits into no single place.
struct MarkerPlaces {
  std::vector<int> usual_photos;      // Of the board: those that agree, the most of them.
  std::vector<int> elsewhere_photos;  // The others.
  double distance = 0.0;              // From there to here, the median [marker diameters].
};

// Of the photos that have a pose and see the marker.
MarkerPlaces FindMarkerPlaces(const BoardSolution& solution, int marker_idx);

}  // namespace plumb
