// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "plumbline/map/map_delta.h"
#include "plumbline/surface/mesh_delta.h"
#include "plumbline/surface/surface_options.h"
#include "plumbline/surface/surface_report.h"

namespace plumb {

struct SurfaceUpdate {
  MeshDelta mesh;
  SurfaceReport report;
};

// Keeps the surface of a growing map: tetrahedra between the landmarks (Delaunay), an energy that
// calls each of them free or occupied by the rays from landmarks to cameras, its least cut, and
// the mesh between free and occupied (paper, section III.C). Only what a delta changes is done
// anew. The mesh is a function of the map alone, not of the way it came about: a mesher that
// starts from a snapshot has the same mesh as one that was there all along. Not thread-safe.
class SurfaceMesher {
 public:
  // Throws std::invalid_argument if options.Problems() is not empty.
  explicit SurfaceMesher(const SurfaceOptions& options);
  ~SurfaceMesher();
  SurfaceMesher(const SurfaceMesher&) = delete;
  SurfaceMesher& operator=(const SurfaceMesher&) = delete;

  // Nothing, and nothing changed, if the delta is no snapshot and not the next in number: ask for
  // a snapshot. What cannot be used of a delta is left out and named in the report; nothing that a
  // delta holds throws. After a snapshot the mesh delta is one as well.
  std::optional<SurfaceUpdate> Apply(const MapDelta& delta);

  // The whole mesh under the number of the last delta, for a late listener.
  MeshDelta Snapshot() const;

  std::uint32_t map_sequence() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
