// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "plumbline/simulation/scenario.h"

namespace plumb::tools {

// The file of a scenario: `scenario` itself if it has a slash or ends in .yaml, else the shipped
// one of that name. Throws std::runtime_error naming those that are shipped if there is none.
std::string FindScenario(const std::string& scenario);

// Reads a scenario; a lens file is looked for beside it. Throws std::runtime_error naming the file,
// the key, what is wrong and the cure, for unknown keys, wrong types and impossible values.
Scenario ReadScenario(const std::string& path);

// All of it; ReadScenario reads it back, for JSON is YAML.
nlohmann::ordered_json ToJson(const Scenario& scenario);

}  // namespace plumb::tools
