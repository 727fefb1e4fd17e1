// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace plumb::tools {

// What is wrong with the command line that `app` has just refused with `error`, and where help is.
// An unknown command or option is named first: it may be the misspelt one that is missing.
std::string DescribeUsageError(const CLI::App& app, const CLI::ParseError& error);

}  // namespace plumb::tools
