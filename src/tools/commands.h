// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "tools/exit_code.h"
#include "tools/flight_bag.h"

namespace plumb::tools {

// Each adds a subcommand to `app` that, when it is given, does its work and sets `*exit_code`. They
// throw std::runtime_error for what is wrong with a file, an option value or the disk.
void AddReconstructCommand(CLI::App* app, ExitCode* exit_code);
void AddCheckCommand(CLI::App* app, ExitCode* exit_code);
void AddEvaluateCommand(CLI::App* app, ExitCode* exit_code);
void AddGeoreferenceCommand(CLI::App* app, ExitCode* exit_code);
void AddExperimentCommand(CLI::App* app, ExitCode* exit_code);
void AddExportCommand(CLI::App* app, ExitCode* exit_code);
void AddMeshCommand(CLI::App* app, ExitCode* exit_code);
void AddMarkersCommand(CLI::App* app, ExitCode* exit_code);
void AddDetectCommand(CLI::App* app, ExitCode* exit_code);
void AddCalibrateCommand(CLI::App* app, ExitCode* exit_code);

// `write_bag` may be empty: no ROS in this build.
void AddSimulateCommand(CLI::App* app, FlightBagWriter write_bag, ExitCode* exit_code);

}  // namespace plumb::tools
