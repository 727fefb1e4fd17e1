// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/usage_error.h"

namespace plumb::tools {

std::string DescribeUsageError(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = "plumbline";
  for (const CLI::App* subcommand : app.get_subcommands()) command += ' ' + subcommand->get_name();
  std::string what = error.what();
  for (const std::string& word : app.remaining(/*recurse=*/true)) {
    if (word.rfind('-', 0) != 0) continue;
    what = "unknown option " + word;
    break;
  }
  return what + "; see " + command + " --help";
}

}  // namespace plumb::tools
