// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <iostream>
#include <memory>

#include "plumbline/common/options.h"
#include "tools/calibrate.h"
#include "tools/commands.h"
#include "tools/options_yaml.h"

namespace plumb::tools {
namespace {

struct Settings {
  std::vector<std::string> calibration;
  std::vector<std::string> detector;
};

template <typename Options>
void ReadSettings(const char* option, const std::vector<std::string>& settings, Options* options) {
  for (const std::string& setting : settings) {
    ReadValue(ParseSetting(setting), {std::string(option) + ' ' + setting, ""}, options);
  }
}

ExitCode Run(CalibrateArguments arguments, const Settings& settings) {
  ReadSettings("--set", settings.calibration, &arguments.calibration);
  ReadSettings("--detector", settings.detector, &arguments.detector);
  ThrowIfProblems("calibration", arguments.calibration.Problems());
  ThrowIfProblems("marker detector", arguments.detector.Problems());
  Console console(&std::cout, ::isatty(STDOUT_FILENO) == 1);
  const CalibrateOutcome outcome = Calibrate(arguments, &console);
  for (const std::string& line : Describe(outcome.result)) console.PrintLine(line);
  if (!arguments.report.empty()) console.PrintLine("report: " + arguments.report + "/report.md");
  if (outcome.has_written) {
    console.PrintLine("camera: " + arguments.output);
  } else {
    console.PrintLine(arguments.output + " was not written.");
  }
  return outcome.has_written ? kDone : kNotCalibrated;
}

}  // namespace

void AddCalibrateCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command =
      app->add_subcommand("calibrate", "Calibrate a camera from photos of coded markers");
  command->footer(
      "The photos show markers of `plumbline markers sheet`, strewn on a plane or as a fixed grid. "
      "Without a good result no camera is written, and it is said what to photograph.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<CalibrateArguments>();
  const auto settings = std::make_shared<Settings>();
  arguments->camera_name = "camera";
  CalibrationOptions& calibration = arguments->calibration;
  command->add_option("--photos", arguments->photos, "Folder of photos, with its sub-folders")
      ->required();
  command->add_option("--output", arguments->output, "The lens: ROS camera_info YAML")->required();
  command->add_option(
      "--report", arguments->report, "Folder for report.md, report.json and pictures");
  command->add_option("--name", arguments->camera_name, "The camera's name in the YAML")
      ->capture_default_str();
  command
      ->add_option("--fixed-grid",
                   calibration.fixed_grid,
                   "a4 or a3: the markers are the fixed grid on one sheet; else they are strewn")
      ->check(CLI::IsMember({"a4", "a3"}));
  command->add_option("--first-id", calibration.first_id, "The fixed grid's first ID")
      ->capture_default_str();
  command->add_option("--diameter-m",
                      calibration.marker_diameter_m,
                      "Of strewn markers, so that lengths are told in metres");
  command->add_flag("--rational", calibration.rational, "rational_polynomial, for wide lenses");
  command->add_flag("--detect-once",
                    arguments->detect_once,
                    "Do not look for the markers again with the lens then known: half the time");
  command->add_flag(
      "--keep-poor", arguments->keep_poor, "Write the camera even if it is not good enough");
  command->add_option("--set", settings->calibration, "KEY=VALUE: an option of the calibration")
      ->allow_extra_args(false);
  command->add_option("--detector", settings->detector, "KEY=VALUE: an option of the detector")
      ->allow_extra_args(false);
  command->callback([arguments, settings, exit_code] { *exit_code = Run(*arguments, *settings); });
}

}  // namespace plumb::tools
