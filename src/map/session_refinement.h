// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "map/sqlite.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

// A refined map beside the map itself: what it has other than that one. The tables are made when
// they are first needed; sessions without them are as good.

// In one transaction, in place of the one before. Precondition: `delta` follows the last one
// applied, sets no new view or landmark and adds no observation.
void WriteRefinement(sqlite::Database* database, const MapDelta& delta);

void DeleteRefinement(sqlite::Database* database);

// Also if it is of an earlier map.
bool HasRefinement(sqlite::Database* database);

// Nothing if there is none, or the map has changed since.
std::optional<MapDelta> ReadRefinedSnapshot(sqlite::Database* database);

}  // namespace plumb
