// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "plumbline/georeference/georeference.h"
#include "tools/experiment_cell.h"

namespace plumb::tools {

// What RunCell says of one bundle, but for its seconds. Null where the targets give no similarity.
nlohmann::ordered_json MeasureMap(const ExperimentData& data,
                                  const Map& map,
                                  const Camera& camera,
                                  const Georeference& georeference);

}  // namespace plumb::tools
