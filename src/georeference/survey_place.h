// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "plumbline/georeference/geo_frame.h"
#include "plumbline/georeference/georeference.h"

namespace plumb {

// The error that says a survey is of another place than the photos' GPS, how far off and the cure:
// its first two axes exchanged, another UTM zone, or whatever else. By the medians of both, so that
// neither a mistyped target nor a photo without a fix decides. Heights are left out: some drones
// count them from where they took off. Nothing if it lies within `max_distance_m`, is local, or
// there is no position.
std::optional<Finding> FindElsewhere(double max_distance_m,
                                     const Survey& survey,
                                     const GeoFrame& frame,
                                     const std::vector<GeodeticPosition>& positions);

}  // namespace plumb
