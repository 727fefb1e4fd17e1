// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/usage_error.h"

namespace plumb::tools {

std::string DescribeUsageError(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = "plumbline";
  for (const CLI::App* subcommand : app.get_subcommands()) command += ' ' + subcommand->get_name();
  const std::vector<std::string> remaining = app.remaining(/*recurse=*/true);
  const bool has_command = !app.get_subcommands().empty();
  std::string what = error.what();
  for (const std::string& word : remaining) {
    if (!has_command && word.rfind('-', 0) != 0) {
      what = "unknown command \"" + word + '"';
      break;
    }
    if (word.rfind('-', 0) != 0) continue;
    what = "unknown option " + word;
    break;
  }
  return what + "; see " + command + " --help";
}

}  // namespace plumb::tools
