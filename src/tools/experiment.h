// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "tools/console.h"
#include "tools/exit_code.h"

namespace plumb::tools {

struct ExperimentArguments {
  std::string flight;                 // Folder that plumbline simulate made.
  std::string output;                 // Folder, new or of the same experiment.
  int num_seeds = 2;                  // Faulty calibrations, with seeds from 1 on.
  std::vector<std::string> rows;      // Only these of the flight's, and "all"; empty: everything.
  std::vector<std::string> settings;  // KEY=VALUE of ExperimentOptions.
  int num_threads = 0;                // 0: all cores.
};

// The experiment of the paper's sections III.D, III.E and IV.C on a simulated flight: each row of
// photos alone, and all together, are reconstructed with a faulty calibration and measured after
// each kind of last bundle. Every reconstruction is a cell that is kept in OUTPUT/cells; cells that
// lie there are not computed again. Then writes the tables (Markdown, CSV, JSON) and plots (SVG).
// When `stop` becomes true it ends after the cells in work. Throws std::runtime_error naming what
// is wrong with the flight, an option value or the disk, and the cure.
ExitCode RunMultiscaleExperiment(const ExperimentArguments& arguments,
                                 const std::atomic<bool>& stop,
                                 Console* console);

}  // namespace plumb::tools
