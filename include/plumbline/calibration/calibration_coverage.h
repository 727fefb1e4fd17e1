// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plumbline/calibration/calibration_photo.h"

namespace plumb {

// One bar: how many photos there are of a kind and how many are wanted. Full at count >= wanted.
struct CoverageBar {
  std::string label;  // For people, e.g. "30 to 45 deg" or "near on the left".
  int count = 0;
  int wanted = 0;
};

// Of CalibrationCoverage::image_share; with less, distortion is a guess where no marker was.
constexpr double kWantedImageShare = 0.7;

// What the photos show so far. Plain values, to be copied freely.
struct CalibrationCoverage {
  int width_px = 0;  // Of the photos; 0 without any.
  int height_px = 0;
  int num_photos = 0;  // With markers.

  // Heat map of the image: how many marker centres lie in each cell, row by row from the top left.
  int num_cols = 0;
  int num_rows = 0;
  std::vector<int> centers_in_cell;
  // Whether a marker's face has touched the cell, in the same order; most of those without a centre
  // are beside one.
  std::vector<char> is_cell_touched;
  // Share of the cells that are touched, 0..1.
  double image_share = 0.0;

  // By the median diameter of the photo's markers against that of all photos: near to far.
  std::vector<CoverageBar> distance;
  double distance_ratio = 1.0;  // Farthest over nearest.
  // By the tilt of the plane to the image, in whole degrees.
  std::vector<CoverageBar> tilt;
  // Which side of the image the plane comes nearer on, of the photos tilted by 15 deg or more.
  std::vector<CoverageBar> direction;
  // True: tilt and direction are those of the estimate, of the photos that it uses. False: guessed
  // from the markers' shapes for a usual lens, of all photos with markers.
  bool is_tilt_estimated = false;
  // How the camera was turned about its axis against the first photo.
  std::vector<CoverageBar> turn;

  int CentersInCell(int col, int row) const {
    return centers_in_cell[static_cast<std::size_t>(row * num_cols + col)];
  }
  bool IsCellTouched(int col, int row) const {
    return is_cell_touched[static_cast<std::size_t>(row * num_cols + col)] != 0;
  }
};

bool IsEveryBarFull(const CalibrationCoverage& coverage);

// Under bars of which some are not full although the verdict is good.
constexpr const char* kNotFullButGood =
    "Grey: not full, and not needed: the lens is known well enough.";

// Of the photos of the size that most have; needs no knowledge of the lens. Deterministic;
// thread-safe.
CalibrationCoverage MeasureCoverage(const std::vector<CalibrationPhoto>& photos);

}  // namespace plumb
