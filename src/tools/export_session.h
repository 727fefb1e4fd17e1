// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plumbline/map/session_store.h"

namespace plumb::tools {

// Writes colmap/{cameras,images,points3D}.txt and points.ply into `folder`, which is made if need
// be; returns what was written. Throws std::runtime_error naming the file and the cause.
std::vector<std::string> ExportSession(const SessionStore& store, const std::string& folder);

}  // namespace plumb::tools
