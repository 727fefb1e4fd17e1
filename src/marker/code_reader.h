// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "marker/gray_sampler.h"
#include "plumbline/marker/marker_detector_options.h"

namespace plumb {

// A code that was read.
struct CodeReading {
  int id = 0;
  int rotation = 0;          // The cells are the code turned by so many.
  int num_wrong_cells = 0;   // That lie on the wrong side of the threshold.
  double angle_rad = 0.0;    // By which the marker's x axis is turned in the canonical circle.
  double probability = 0.0;  // Of the code against all others.
};

// What is known before.
struct CodeSearch {
  bool is_upright = false;  // The marker's x axis is the canonical circle's; no rotation is sought.
  double blur_px = 0.9;     // Sigma.
};

// Reads the code through a homography from the canonical circle (the marker's frame but for a
// rotation) to pixels: verifies the circles, unrolls the code stripe from the photo, bins it into
// cells by a histogram over the angle, and takes the code that explains the cells best, if it is
// the only likely one and the codebook finds no other one for the thresholded cells. Nothing if it
// is no marker.
std::optional<CodeReading> ReadCode(const MarkerDetectorOptions& options,
                                    const GraySampler& gray,
                                    const Eigen::Matrix3d& pixel_from_circle,
                                    const CodeSearch& search);

}  // namespace plumb
