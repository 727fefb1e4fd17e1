// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plumb::tools {

// What the program says to the shell.
enum ExitCode {
  kDone = 0,            // Also with refused photos: the report names them.
  kFailed = 1,          // A file, an option value or the disk; the message names it and the cure.
  kWrongUsage = 2,      // The command line itself.
  kNothingLocated = 3,  // All photos were looked at, none could be located or even used.
  kNotCalibrated = 4,   // The photos do not give a good calibration; what to photograph was said.
  kInterrupted = 130    // Ended by Ctrl-C or SIGTERM; what there was is kept.
};

// The same, for --help.
constexpr char kExitCodes[] =
    "Exit codes: 0 done (the report names refused photos); 1 a file, an option value or the disk, "
    "named with its cure; 2 wrong usage; 3 no photo could be located, or none was usable; 4 no good "
    "calibration; 130 ended by Ctrl-C, what there was is kept.";

}  // namespace plumb::tools
