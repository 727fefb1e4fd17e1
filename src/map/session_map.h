// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "map/sqlite.h"
#include "plumbline/map/map_delta.h"

namespace plumb {

// The map's part of a session: the tables views, landmarks and observations, and the lens.

// Applies `delta` in one transaction. It must follow the last one applied, or be a snapshot.
void ApplyDelta(sqlite::Database* database, const MapDelta& delta);

// The whole map under the number of the last delta applied.
MapDelta ReadSnapshot(sqlite::Database* database);

// The same for a caller that has a ReadTransaction of its own, in which it reads more.
MapDelta ReadSnapshotInTransaction(sqlite::Database* database);

}  // namespace plumb
