// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/simulation/flight.h"
#include "plumbline/simulation/renderer.h"

namespace plumb {

// Throws std::invalid_argument naming the first photo whose camera is inside something or so near
// to it that no pilot would fly there, with the cure.
void CheckClearance(const Renderer& renderer, const std::vector<PlannedPhoto>& photos);

}  // namespace plumb
