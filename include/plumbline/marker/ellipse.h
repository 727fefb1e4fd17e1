// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace plumb {

// An ellipse in the image; pixel (0, 0) is the top-left pixel's centre.
struct Ellipse {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  // Of the major axis, from x towards y, in [0, pi).

  // Maps the unit circle onto the ellipse, less the centre; symmetric.
  Eigen::Matrix2d PixelFromCircle() const;
};

// The ellipse with a given centre that is the image of the unit circle under `pixel_from_circle`.
Ellipse EllipseOfAffine(const Eigen::Vector2d& center_px, const Eigen::Matrix2d& pixel_from_circle);

// The same by the square of the map, pixel_from_circle pixel_from_circle^T [px^2]: symmetric, with
// a determinant of at least 0.
Ellipse EllipseOfSquare(const Eigen::Vector2d& center_px, const Eigen::Matrix2d& square);

// Least squares on the algebraic distance, constrained to ellipses (Halir & Flusser, Numerically
// stable direct least squares fitting of ellipses, WSCG 1998), on normalised points.
// Nothing with fewer than 6 points or if they do not lie about an ellipse.
std::optional<Ellipse> FitEllipse(const std::vector<Eigen::Vector2d>& points_px);

}  // namespace plumb
