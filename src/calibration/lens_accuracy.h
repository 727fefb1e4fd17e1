// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "plumbline/camera/projection.h"

namespace plumb {

// LensEstimate::distortion_sigma_px of a lens with a covariance in the order of LensParameters.
double DistortionSigma(int width_px,
                       int height_px,
                       const LensParameters<double>& lens,
                       const Eigen::MatrixXd& covariance);

// RMS over the image, in pixels, of how two lenses differ, less what another focal length,
// principal point and turn of the camera take away.
double DistortionDifference(int width_px,
                            int height_px,
                            const LensParameters<double>& truth,
                            const LensParameters<double>& other);

}  // namespace plumb
