// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "plumbline/surface/surface_options.h"
#include "surface/tetrahedra.h"

namespace plumb {

// The energy of the paper's section III.C, from the counts in the cells. Free is the source's
// label. Infinite cells are free: the cameras hover outside the hull.

// Cost of the label occupied minus cost of the label free. A face of the hull that rays leave by
// is a cost of occupied. Any other is none: behind a wall that was only seen from in front the
// world ends, and what closes it there is dropped anyway (FaceSupport).
std::int32_t TerminalOf(const SurfaceOptions& options,
                        const Triangulation& triangulation,
                        Cell cell);

// Cost of unlike labels on both sides of face `i`. The paper sums over the neighbours of every
// cell, so a face counts once from each side. The sum is taken times 1 - min(cos phi, cos psi), phi
// and psi being the angles between the face and the spheres about the cells on both sides
// (Labatut et al., Computer Graphics Forum 28(8), 2009, eq. 5): what is wide open on one side and
// thin on the other is no surface.
std::int32_t FaceWeightOf(const SurfaceOptions& options, Cell cell, int i);

// Infinite cells have no node and are free.
inline bool IsFree(const DynamicCut& cut, Cell cell) {
  return cell->info().node == kNoCutNode || cut.IsAtSource(cell->info().node);
}

// Energy of the labels that IsFree gives. Walks over all cells.
std::int64_t EnergyOf(const SurfaceOptions& options,
                      const Triangulation& triangulation,
                      const DynamicCut& cut);

}  // namespace plumb
