// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/flight_bag.h"

namespace plumb::ros_adapter {

// Implements tools::FlightBagWriter: /plumbline/photo as replay.launch plays it. Deterministic.
void WriteFlightBag(const std::string& path,
                    const Camera& camera,
                    const std::vector<tools::RecordedPhoto>& photos);

}  // namespace plumb::ros_adapter
