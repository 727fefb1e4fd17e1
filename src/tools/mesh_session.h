// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumbline/map/session_store.h"
#include "plumbline/surface/surface_options.h"
#include "tools/session_map.h"

namespace plumb::tools {

// Writes mesh.ply and mesh.obj of the session's map, refined if it was, into `folder`, which is
// made if need be: in the frame of the points that ExportSession writes, with its frame.json. Gives
// counts, seconds, what was left out, the frame, and as "stale" what ExportFolder says. Throws
// std::runtime_error naming the file and the cause, std::invalid_argument for the options.
nlohmann::ordered_json MeshSession(const SurfaceOptions& options,
                                   const SessionStore& store,
                                   const SessionMap& map,
                                   const std::string& folder);

}  // namespace plumb::tools
