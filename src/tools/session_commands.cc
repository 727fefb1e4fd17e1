// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "plumbline/map/session_store.h"
#include "tools/commands.h"
#include "tools/export_session.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

struct SessionArguments {
  std::string session;
  std::string path;
};

}  // namespace

void AddExportCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command =
      app->add_subcommand("export", "Write the map of a session for other programs");
  command->footer(
      "Writes colmap/{cameras,images,points3D}.txt (COLMAP's text model) and points.ply, in the "
      "map's frame and unit of length. After plumbline georeference in metres: points.ply in the "
      "survey's CRS less an offset, COLMAP's model in the local frame about it; frame.json says "
      "which.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<SessionArguments>();
  command->add_option("--session", arguments->session, "Folder of the session")->required();
  command->add_option(
      "--to,--output", arguments->path, "Folder to write to (default: SESSION/export)");
  command->callback([arguments, exit_code] {
    const SessionStore store = SessionStore::OpenExisting(arguments->session);
    const SessionMap map = ReadSessionMap(store);
    if (map.snapshot.views_set.empty()) {
      std::cerr << WhyNothingIsLocated(store) << "; there is nothing to export\n";
      *exit_code = kNothingLocated;
      return;
    }
    const std::string folder =
        arguments->path.empty() ? arguments->session + "/export" : arguments->path;
    const ExportedSession exported = ExportSession(store, map, folder);
    for (const std::string& line : exported.lines) std::cout << line << '\n';
    if (!exported.lacks.empty()) std::cout << exported.lacks << '\n';
    *exit_code = kDone;
  });
}

}  // namespace plumb::tools
