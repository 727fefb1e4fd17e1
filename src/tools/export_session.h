// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/map/session_store.h"
#include "tools/session_map.h"

namespace plumb::tools {

// What an export did, for a person.
struct ExportedSession {
  std::vector<std::string> lines;  // "wrote …" of each file, and in which frame if not the map's.
  std::string lacks;               // What the map still lacks and how to give it; empty if nothing.
};

// Writes colmap/{cameras,images,points3D}.txt and points.ply into `folder`, which is made if need
// be. Without a georeference of this very map, in the map's frame. With one:
//   colmap      the local metric frame enu: COLMAP's cameras need a Euclidean one
//   points.ply  the survey's CRS less the frame's origin, which stands in its comments; enu if the
//               CRS counts in degrees
//   frame.json  the CRS and the origin
// What Plumbline wrote there of another map or georeference is deleted (ExportFolder).
// Throws std::runtime_error naming the file and the cause.
ExportedSession ExportSession(const SessionStore& store,
                              const SessionMap& map,
                              const std::string& folder);

}  // namespace plumb::tools
