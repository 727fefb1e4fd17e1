// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/session_map.h"

#include <utility>

namespace plumb::tools {

SessionMap ReadSessionMap(const SessionStore& store) {
  std::optional<MapDelta> refined = store.RefinedSnapshot();
  if (refined) return {std::move(*refined), true};
  return {store.Snapshot(), false};
}

}  // namespace plumb::tools
