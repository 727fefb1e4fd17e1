// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "calibration/board.h"

namespace plumb {

// By how much a detector that knows no lens sees the centre of a marker beside its place [px]: it
// lays a homography over a face whose image is bent by the distortion. Zero where the state does
// not show the whole marker. The edges' circles are laid over as the detector lays over the face.
Eigen::Vector2d CenterShift(const MarkerView& view, const BoardState& state);

}  // namespace plumb
