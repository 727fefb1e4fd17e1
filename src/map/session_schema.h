// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "map/sqlite.h"
#include "plumbline/camera/camera.h"

namespace plumb {

// Makes the tables of a session in an empty database, and checks that a filled one is a
// session of this schema and of this camera. Throws std::runtime_error naming the file and the
// cure.
void PrepareSession(sqlite::Database* database, const Camera& camera);

// The camera with which the session was made. Throws std::runtime_error as above.
Camera ReadSessionCamera(sqlite::Database* database);

}  // namespace plumb
