// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/map/map.h"
#include "plumbline/map/session_store.h"
#include "plumbline/sfm/mapper.h"

namespace plumb {

// What Mapper::Restore needs of a session, and what is still to be done.
struct StoredSession {
  std::vector<MapperPhoto> photos;
  std::vector<PhotoVerdict> verdicts;  // One for each of `photos`.
  MapDelta snapshot;

  // Kept, but cut off before their verdict and map were: to be added again, by id.
  std::vector<StoredPhoto> unfinished;
};

// Reads a session that may have been cut off at any moment. A photo whose verdict says accepted
// but whose view did not reach the disk counts as unfinished. Throws as SessionStore does.
StoredSession ReadStoredSession(const SessionStore& store);

// The map of a session as it is stored, with its features; a refinement is not looked at. Throws as
// SessionStore does.
Map ReadStoredMap(const SessionStore& store);

}  // namespace plumb
