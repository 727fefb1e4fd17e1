// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "plumbline/sfm/mapper_options.h"
#include "tools/console.h"
#include "tools/exit_code.h"

namespace plumb::tools {

struct ReconstructArguments {
  std::string photos;                 // Folder.
  std::string camera;                 // ROS camera_info YAML.
  std::string session;                // Folder, new or one to go on with.
  std::string options;                // YAML of MapperOptions; empty: the defaults.
  std::vector<std::string> settings;  // KEY=VALUE, after the file.
  std::string order = "name";
};

// MapperOptions by the file and the settings. Throws std::runtime_error naming the source, the
// field and the cure.
MapperOptions ReadMapperOptions(const ReconstructArguments& arguments);

// Feeds the photos through the mapper into the session, then writes report.json and export/.
// In a session with photos it goes on: unfinished ones first, those it has answered are skipped.
// Where nothing is new and the last run with these options was complete, all stays as it is. When
// `stop` becomes true it ends after the photo in work and keeps what there is. Throws
// std::runtime_error for a file, an option value or the disk.
ExitCode Reconstruct(const ReconstructArguments& arguments,
                     const std::atomic<bool>& stop,
                     Console* console);

}  // namespace plumb::tools
