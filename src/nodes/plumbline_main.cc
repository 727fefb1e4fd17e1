// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#ifdef PLUMBLINE_WITH_ROS
#include "ros/flight_bag.h"
#endif
#include "tools/commands.h"
#include "tools/usage_error.h"

namespace {

plumb::tools::FlightBagWriter BagWriter() {
#ifdef PLUMBLINE_WITH_ROS
  return plumb::ros_adapter::WriteFlightBag;
#else
  return {};
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace plumb::tools;
  CLI::App app("Photos of a facade become a measured map.", "plumbline");
  app.set_version_flag("--version", "plumbline " PLUMBLINE_VERSION);
  app.require_subcommand(1);
  app.footer(kExitCodes);
  ExitCode exit_code = kDone;
  AddReconstructCommand(&app, &exit_code);
  AddCheckCommand(&app, &exit_code);
  AddEvaluateCommand(&app, &exit_code);
  AddGeoreferenceCommand(&app, &exit_code);
  AddExperimentCommand(&app, &exit_code);
  AddExportCommand(&app, &exit_code);
  AddMeshCommand(&app, &exit_code);
  AddMarkersCommand(&app, &exit_code);
  AddDetectCommand(&app, &exit_code);
  AddCalibrateCommand(&app, &exit_code);
  AddSimulateCommand(&app, BagWriter(), &exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version.
    std::cerr << "plumbline: " << DescribeUsageError(app, error) << '\n';
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "plumbline: " << error.what() << '\n';
    return kFailed;
  }
  return exit_code;
}
