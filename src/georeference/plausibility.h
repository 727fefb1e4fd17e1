// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "georeference/gps_alignment.h"
#include "plumbline/georeference/georeference.h"
#include "plumbline/georeference/georeferencer_options.h"

namespace plumb {

// Fills in georeference->gps: what the similarity by targets, if there is one, says against that
// by GPS.
void CompareWithGps(const RobustSimilarity* by_targets,
                    const RobustSimilarity& by_gps,
                    const GeoFrame* frame,
                    const std::vector<GpsPhoto>& photos,
                    Georeference* georeference);

// Adds what is implausible about the similarity by targets: feet for metres, by the GPS's scale or
// by the size of the markers; a height in another column, by what is up. It is an error where the
// survey's coordinates cannot be meant as they are.
void CheckShape(const GeoreferencerOptions& options,
                const Survey& survey,
                const Similarity3& enu_from_map,
                Georeference* georeference);

// Warns of a place by targets that GPS, as far as it can be off, disputes.
void CheckPlace(const GeoreferencerOptions& options,
                HeightReference heights,
                Georeference* georeference);

}  // namespace plumb
