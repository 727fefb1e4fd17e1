// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace plumb {

// The face of a coded marker. Its frame: origin in the centre, x right, y down as printed
// (angles grow from x to y), lengths in outer radii. From the outside to the centre:
//   1 .. kQuietRadius           white: the quiet zone
//   kStripeOuterRadius .. 1     black: the outer circle, whose edge is measured
//   kStripeInnerRadius .. kStripeOuterRadius   the code stripe: cell i, white where bit i is set,
//                               from angle i to i + 1 times 2 pi / kNumCodeBits
//   kDiscRadius .. kStripeInnerRadius          black
//   0 .. kDiscRadius            white: the centre disc, with a hair cross to aim at
// Reasons. The face is dark on white, so that it stays one dark blob where nothing else of it can
// be made out any more. The black ring keeps the blur of the code (sigma of a pixel) away from the
// outer edge from 12 px of diameter on. The stripe lies far out: at a diameter of 16 px a cell is
// still 1.8 px long and 3 px wide. The disc gives a second circle, complete and concentric: it
// verifies, and with the outer one tells the perspective.
constexpr int kNumCodeBits = 17;
constexpr double kQuietRadius = 1.25;
constexpr double kStripeOuterRadius = 0.8;
constexpr double kStripeInnerRadius = 0.42;
constexpr double kDiscRadius = 0.2;

// The hair cross of printed sheets; what lies within is not measured.
constexpr double kCrossRadius = 0.06;

// The side of the square that holds the quiet zone, over the marker's diameter.
constexpr double kSidePerDiameter = kQuietRadius;

// Whether a point of the marker's frame is white.
bool IsWhite(std::uint32_t word, const Eigen::Vector2d& point_in_marker);

}  // namespace plumb
