// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/map/photo_verdict.h"

namespace plumb {

// What the pilot can do about a refused or waiting photo, one or two short sentences.
// `other` names the photo it looks most like, or is the same as; may be empty.
std::string HintFor(RefusalReason reason, const std::string& other);

// The same while no map has begun: what is still missing for one. kNone: the first photo.
std::string HintWithoutMap(RefusalReason reason, const std::string& other);

}  // namespace plumb
