// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumbline/georeference/georeferencer.h"
#include "plumbline/map/session_store.h"
#include "tools/console.h"

namespace plumb::tools {

struct GeoreferenceArguments {
  std::string session;
  std::string survey;                 // File; empty: by the photos' GPS alone.
  std::string crs;                    // Instead of the file's; empty: as the file says.
  std::string heights;                // The same.
  std::vector<std::string> settings;  // KEY=VALUE of GeoreferencerOptions, refinement.KEY=VALUE.
  bool refine = false;                // The map, by a bundle with the survey.
  int num_threads = 0;                // 0: all cores.
};

// A session's georeference and what it was computed from.
struct SessionGeoreference {
  std::optional<Survey> survey;
  Georeference georeference;
  std::vector<PointedTarget> sightings;  // Of the targets, in photos by their original names.
};

// Where a session keeps its georeference.
std::string GeoreferencePath(const std::string& session);

// Finds the markers in the session's located photos and computes the georeference of `snapshot`,
// the session's map or the refined one; writes nothing. Photos that cannot be read are named on the
// console and left out. Throws std::runtime_error for the survey, an option value, or a session
// without located photos.
SessionGeoreference GeoreferenceSession(const GeoreferenceArguments& arguments,
                                        const SessionStore& store,
                                        const MapDelta& snapshot,
                                        Console* console);

// What makes a georeference useless, in one line; empty if nothing does.
std::string JoinedErrors(const Georeference& georeference);

// A table of the targets and what there is to say, line by line, for a person; of a useless
// georeference the table alone.
std::vector<std::string> Describe(const Georeference& georeference);

// Computes the georeference, prints it, and writes it to GeoreferencePath, and beside it
// gcp_list.txt if the survey has a CRS. To refine, that is done once more after a bundle of the
// whole map with its markers, which the session keeps beside its map (SaveRefinement); else a
// refinement that there was is dropped. Exports of another map or georeference are deleted there,
// as far as Plumbline wrote them (ExportFolder). Throws std::runtime_error, and leaves what was
// there, if there is none, or the survey cannot be used as it is, or another program writes the
// session.
void WriteSessionGeoreference(const GeoreferenceArguments& arguments, Console* console);

}  // namespace plumb::tools
