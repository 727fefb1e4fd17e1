// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>
#include <string>

#include "tools/commands.h"
#include "tools/simulate.h"
#include "tools/stop_signal.h"

namespace plumb::tools {
void AddSimulateCommand(CLI::App* app, FlightBagWriter write_bag, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand(
      "simulate", "Photos of a simulated facade with its exact truth, as a flight leaves them");
  command->footer(
      "Writes OUTPUT/{photos,camera.yaml,camera_wrong.yaml,survey.csv,telemetry.csv,flight.bag,"
      "ground_truth,scenario.yaml}; OUTPUT/README.md says what each is. A run that was cut off "
      "goes on where it was. Lengths in m, world: x right along the wall, y into it, z up.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<SimulateArguments>();
  command
      ->add_option("--scenario", arguments->scenario, "Name of a shipped scenario, or a YAML file")
      ->required();
  command->add_option("--output", arguments->output, "Folder, new or of the same scenario")
      ->required();
  command->add_option(
      "--seed", arguments->seed, "Instead of the scenario's: another flight, the same facade");
  command->add_option("--threads", arguments->num_threads, "0: all cores")
      ->check(CLI::Range(0, 1024));
  command->add_option("--rows", arguments->rows, "Only these rows' photos, e.g. 4m,10m")
      ->delimiter(',');
  command->add_option("--photos", arguments->max_photos, "Only the first so many photos")
      ->check(CLI::Range(1, 1'000'000));
  command->add_flag("--no-bag", arguments->no_bag, "Write no flight.bag");
  command->callback([arguments, write_bag = std::move(write_bag), exit_code] {
    Console console(&std::cout, ::isatty(STDOUT_FILENO) == 1);
    *exit_code = Simulate(*arguments, write_bag, StopOnSignal(), &console);
  });
}

}  // namespace plumb::tools
