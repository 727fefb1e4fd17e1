// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/console.h"
#include "tools/exit_code.h"
#include "tools/flight_bag.h"

namespace plumb::tools {

struct SimulateArguments {
  std::string scenario;               // Name of a shipped one, or a file.
  std::string output;                 // Folder, new or of the same scenario.
  std::optional<std::uint32_t> seed;  // Instead of the scenario's.
  int num_threads = 0;                // 0: all cores.
  std::vector<std::string> rows;      // Only these rows' photos; empty: all.
  int max_photos = 0;                 // Only the first so many of them; 0: all.
  bool no_bag = false;
};

// Writes a simulated flight with its truth; what is what, its README.md says. Photos that lie there
// of the same scenario are kept. `write_bag` may be empty: no ROS in this build. When `stop`
// becomes true it ends after the photos in work. Throws std::runtime_error or std::invalid_argument
// for the scenario, a folder of another one, or the disk.
ExitCode Simulate(const SimulateArguments& arguments,
                  const FlightBagWriter& write_bag,
                  const std::atomic<bool>& stop,
                  Console* console);

}  // namespace plumb::tools
