// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "marker/face_fit.h"
#include "marker/gray_sampler.h"
#include "marker/local_lens.h"
#include "plumbline/marker/marker_detector.h"

namespace plumb {

// Grey values of the face of `detection` (its ID and ellipse are used), at flat pixels relative to
// the lens's origin: those about its edges, and some of the others, for they tell black and white.
// `pixel_from_marker` to raw pixels.
std::vector<FaceSample> SampleFace(const GraySampler& gray,
                                   const LocalLens& lens,
                                   const MarkerDetection& detection,
                                   const Eigen::Matrix3d& pixel_from_marker);

}  // namespace plumb
