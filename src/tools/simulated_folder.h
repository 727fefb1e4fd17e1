// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plumbline/simulation/photographer.h"

namespace plumb::tools {

// Makes the folder, or takes one that holds a flight of the same scenario; removes what an
// interrupted run left half written. Throws std::runtime_error naming the folder and the cure if
// it holds anything else.
void OpenSimulatedFolder(const std::string& folder, const Scenario& scenario);

std::string PhotoFile(const std::string& folder, const PlannedPhoto& photo);

// Everything but photos, surface, laser scan and bag. `photo_idxs`: the photos that are wanted.
void WriteFlightFiles(const Photographer& photographer,
                      const std::vector<std::size_t>& photo_idxs,
                      const std::string& folder);

// The surface and what a laser scanner sees of it, where they do not lie there yet.
void WriteTrueSurface(const Photographer& photographer, int num_threads, const std::string& folder);

}  // namespace plumb::tools
