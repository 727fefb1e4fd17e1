// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>

#include "tools/commands.h"
#include "tools/georeference.h"

namespace plumb::tools {

void AddGeoreferenceCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand(
      "georeference", "Place a session's map by surveyed markers, or by the photos' GPS");
  command->footer(
      "Finds the coded markers in the located photos, pairs them with the survey by their ids and "
      "prints each one's residual (model less survey) [mm] with its expected size. Writes "
      "SESSION/export/georeference.json, which plumbline export follows, and gcp_list.txt for "
      "OpenDroneMap; of what was exported before, what is of another georeference is deleted. See "
      "docs/georeference.md.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<GeoreferenceArguments>();
  command->add_option("--session", arguments->session, "Folder of the session")->required();
  command->add_option("--survey",
                      arguments->survey,
                      "CSV: id,x_m,y_m,z_m[,sigma_m][,role], or OpenDroneMap's gcp_list.txt; "
                      "without it the photos' GPS is taken, metres off");
  command->add_option(
      "--crs", arguments->crs, "Of the survey, instead of its own word: EPSG:31256, … or local");
  command->add_option("--heights",
                      arguments->heights,
                      "Of the survey, instead of its own word: ellipsoidal or orthometric");
  command
      ->add_option(
          "--set",
          arguments->settings,
          "KEY=VALUE: one option of GeoreferencerOptions, e.g. marker_diameter_m=0.3, or of "
          "RefinementOptions, e.g. refinement.bundle.distance_exponent=1; repeat")
      ->allow_extra_args(false);
  command->add_flag("--refine",
                    arguments->refine,
                    "Bundle the whole map once more with markers, control points and the lens; the "
                    "session keeps the result beside its map, for export and evaluate. Without it "
                    "they go back to the map as it was");
  command->add_option("--threads", arguments->num_threads, "0: all cores")
      ->check(CLI::Range(0, 1024));
  command->callback([arguments, exit_code] {
    Console console(&std::cout, ::isatty(STDOUT_FILENO) == 1);
    WriteSessionGeoreference(*arguments, &console);
    *exit_code = kDone;
  });
}

}  // namespace plumb::tools
