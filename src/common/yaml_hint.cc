// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/yaml_hint.h"

#include <sstream>

namespace plumb {

std::string TabulatorHint(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::size_t tabulator = line.find('\t');
    if (tabulator == std::string::npos || line.find_first_not_of(" \t") < tabulator) continue;
    return "; line " + std::to_string(number) + " is indented by a tabulator: use spaces";
  }
  return {};
}

}  // namespace plumb
