// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/experiment_report.h"

namespace plumb::tools {

// SVG files. Empty where nothing was measured.

// Check-point errors as bars, a group for each choice of rows.
std::string DrawErrors(const std::vector<ExperimentLine>& lines);

// How the wall is bent along its length, of the first seed: one panel for each choice of rows.
std::string DrawBend(const std::vector<std::string>& rows,
                     const std::vector<nlohmann::ordered_json>& cells);

// Distances of the map's points from the laser scan, all rows (else the first) of the first seed,
// multi-scale bundle.
std::string DrawLaserHistogram(const std::vector<nlohmann::ordered_json>& cells);

}  // namespace plumb::tools
