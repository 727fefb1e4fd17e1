// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "plumbline/georeference/georeference.h"
#include "plumbline/georeference/georeferencer_options.h"
#include "plumbline/georeference/robust_similarity.h"

namespace plumb {

// Fits enu_from_map to the control points among georeference->targets that wait, and fills in
// their and the check points' states, residuals and summaries, and the findings about them.
// Nothing, with a finding that says why, if they determine no similarity.
std::optional<RobustSimilarity> AdjustToTargets(const GeoreferencerOptions& options,
                                                const Survey& survey,
                                                const GeoFrame& frame,
                                                Georeference* georeference);

}  // namespace plumb
