// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>
#include <string>

#include "tools/commands.h"
#include "tools/reconstruct.h"
#include "tools/stop_signal.h"

namespace plumb::tools {
void AddReconstructCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand(
      "reconstruct", "Locate the photos of a folder and build the map, as in flight");
  command->footer(
      "Prints a line for each verdict: name, verdict, reason and hint, how many landmarks agree "
      "with the pose and to how many px (median); seconds from the first byte to the verdict.\n"
      "Writes SESSION/{photos,session.db,report.json,export}. A session that was cut off goes on "
      "where it was: photos it has answered are skipped by name and content. What is no photo by "
      "its name is skipped as well, and said.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<ReconstructArguments>();
  command->add_option("--photos", arguments->photos, "Folder of photos, with its sub-folders")
      ->required();
  command->add_option("--camera", arguments->camera, "Lens: ROS camera_info YAML, lengths in px")
      ->required();
  command->add_option("--session", arguments->session, "Folder of the session, new or old")
      ->required();
  command->add_option("--options",
                      arguments->options,
                      "YAML of mapper options, units in their names (_px, _deg, _s)");
  command->add_option("--set", arguments->settings, "KEY=VALUE: one option, after the file; repeat")
      ->allow_extra_args(false);
  command
      ->add_option("--order",
                   arguments->order,
                   "name (natural order), reverse, or shuffle:SEED with a whole number")
      ->capture_default_str();
  command->callback([arguments, exit_code] {
    Console console(&std::cout, ::isatty(STDOUT_FILENO) == 1);
    *exit_code = Reconstruct(*arguments, StopOnSignal(), &console);
  });
}

}  // namespace plumb::tools
