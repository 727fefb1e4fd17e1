// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>

#include "tools/commands.h"
#include "tools/experiment.h"
#include "tools/stop_signal.h"

namespace plumb::tools {
void AddExperimentCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* experiment =
      app->add_subcommand("experiment", "Measure what a choice of photos and bundle is worth");
  experiment->require_subcommand(1);
  CLI::App* command = experiment->add_subcommand(
      "multiscale", "Rows of photos alone and together, each kind of last bundle");
  command->footer(
      "On a flight by plumbline simulate: each row alone and all together are reconstructed with "
      "faulty calibrations, bundled in four ways, placed by the control points and measured at the "
      "check points. Writes OUTPUT/tables.md, results.csv, results.json, errors.svg, bend.svg, "
      "laser.svg. A run that was cut off goes on with the same command. See docs/bundle.md.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<ExperimentArguments>();
  command->add_option("--flight", arguments->flight, "Folder that plumbline simulate made")
      ->required();
  command->add_option("--output", arguments->output, "Folder, new or of the same experiment")
      ->required();
  command->add_option("--seeds", arguments->num_seeds, "Faulty calibrations")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--rows", arguments->rows, "Only these rows of the flight, and \"all\"; repeat")
      ->allow_extra_args(false);
  command
      ->add_option("--set",
                   arguments->settings,
                   "KEY=VALUE: an option of ExperimentOptions, e.g. distance_exponent=2; repeat")
      ->allow_extra_args(false);
  command->add_option("--threads", arguments->num_threads, "Reconstructions at once; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command->callback([arguments, exit_code] {
    Console console(&std::cout, ::isatty(STDOUT_FILENO) == 1);
    *exit_code = RunMultiscaleExperiment(*arguments, StopOnSignal(), &console);
  });
}

}  // namespace plumb::tools
