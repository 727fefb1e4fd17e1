// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumb {

// What to add to the error of a YAML parser: the first line that is indented by a tabulator, which
// YAML forbids and editors do not show. Empty if there is none.
std::string TabulatorHint(const std::string& text);

}  // namespace plumb
