// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/map/session_store.h"

namespace plumb::tools {

// A session's map, as it was refined if it was.
struct SessionMap {
  MapDelta snapshot;
  bool is_refined = false;
};

SessionMap ReadSessionMap(const SessionStore& store);

// Why the map of a session without located photos is empty, and what to do.
std::string WhyNothingIsLocated(const SessionStore& store);

}  // namespace plumb::tools
