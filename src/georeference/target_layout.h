// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plumbline/georeference/georeference.h"

namespace plumb {

// What is wrong with where the good control points are: too few to notice a wrong one, nearly on a
// line, or on one side of the model. Both in enu [m]; `model` holds a sample of its points.
std::vector<Finding> CheckLayout(double min_coverage,
                                 const std::vector<Eigen::Vector3d>& control,
                                 const std::vector<Eigen::Vector3d>& model);

}  // namespace plumb
