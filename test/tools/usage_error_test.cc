// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/usage_error.h"

#include <gtest/gtest.h>

#include "tools/commands.h"

namespace plumb::tools {
namespace {

std::string ErrorOf(const std::string& line) {
  CLI::App app("", "plumbline");
  app.require_subcommand(1);
  ExitCode exit_code = kDone;
  AddReconstructCommand(&app, &exit_code);
  try {
    app.parse(line, /*program_name_included=*/false);
  } catch (const CLI::ParseError& error) {
    return DescribeUsageError(app, error);
  }
  return {};
}

TEST(DescribeUsageError, NamesTheUnknownOptionBeforeTheMissingOnes) {
  EXPECT_EQ(ErrorOf("reconstruct --foo"), "unknown option --foo; see plumbline reconstruct --help");
  EXPECT_EQ(ErrorOf("reconstruct --photo p --camera c --session s"),
            "unknown option --photo; see plumbline reconstruct --help");
}

TEST(DescribeUsageError, NamesAnUnknownCommandBeforeItsOptions) {
  EXPECT_EQ(ErrorOf("recontsruct --photos few"),
            "unknown command \"recontsruct\"; see plumbline --help");
  EXPECT_EQ(ErrorOf("--foo"), "unknown option --foo; see plumbline --help");
}

TEST(DescribeUsageError, NamesWhatIsMissing) {
  EXPECT_EQ(ErrorOf("reconstruct"), "--photos is required; see plumbline reconstruct --help");
  EXPECT_EQ(ErrorOf(""), "A subcommand is required; see plumbline --help");
}

}  // namespace
}  // namespace plumb::tools
