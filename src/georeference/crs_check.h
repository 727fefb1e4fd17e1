// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "plumbline/georeference/survey.h"

namespace plumb {

// Opens the survey's CRS, settles what its heights are if the CRS says so itself, and sees to it
// that all points lie in the area for which it was made. Throws std::invalid_argument saying what
// is wrong and the cure, also if the points would lie there with exchanged axes.
// `has_degree_columns` is what the file says of its unit, if anything.
void CheckCrs(std::optional<bool> has_degree_columns, Survey* survey);

}  // namespace plumb
