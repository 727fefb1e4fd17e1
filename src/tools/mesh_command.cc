// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "plumbline/common/options.h"
#include "tools/commands.h"
#include "tools/mesh_session.h"
#include "tools/options_yaml.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

struct MeshArguments {
  std::string session;
  std::string folder;
  std::vector<std::string> settings;
};

SurfaceOptions ReadOptions(const std::vector<std::string>& settings) {
  SurfaceOptions options;
  for (const std::string& setting : settings) {
    ReadValue(ParseSetting(setting), {"--set " + setting, ""}, &options);
  }
  ThrowIfProblems("surface", options.Problems());
  return options;
}

}  // namespace

void AddMeshCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand("mesh", "Make the surface of a session's map");
  command->footer(
      "Writes mesh.ply and mesh.obj, triangles between the landmarks, in the map's frame and unit "
      "of length; after plumbline georeference, like plumbline export, in metres in the survey's "
      "CRS less an offset, which frame.json names. Prints a line of JSON: counts, seconds of each "
      "stage, the frame, and what of the map could not be used. The mesh is the one that a flight "
      "ends with; see docs/surface.md.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<MeshArguments>();
  command->add_option("--session", arguments->session, "Folder of the session")->required();
  command->add_option(
      "--to,--output", arguments->folder, "Folder to write to (default: SESSION/export)");
  command
      ->add_option(
          "--set",
          arguments->settings,
          "KEY=VALUE: an option of surface/ in docs/parameters.md, e.g. num_threads=2; repeat")
      ->allow_extra_args(false);
  command->callback([arguments, exit_code] {
    const SurfaceOptions options = ReadOptions(arguments->settings);
    const SessionStore store = SessionStore::OpenExisting(arguments->session);
    const std::string folder =
        arguments->folder.empty() ? arguments->session + "/export" : arguments->folder;
    const SessionMap map = ReadSessionMap(store);
    if (map.snapshot.views_set.empty()) {
      std::cerr << WhyNothingIsLocated(store) << "; there is no mesh to make\n";
      *exit_code = kNothingLocated;
      return;
    }
    const nlohmann::ordered_json report = MeshSession(options, store, map, folder);
    std::cout << report.dump() << '\n';
    for (const auto& line : report.at("stale")) std::cerr << line.get<std::string>() << '\n';
    if (report.contains("outdated")) {
      std::cerr << report.at("outdated").get<std::string>() << '\n';
    }
    const bool is_empty = report.at("faces") == 0;
    if (is_empty) {
      std::cerr << arguments->session
                << ": its landmarks make no surface, and nothing was written: photograph it from "
                   "more places and run plumbline reconstruct again, or leave out what --set "
                   "changes\n";
    }
    *exit_code = is_empty ? kFailed : kDone;
  });
}

}  // namespace plumb::tools
